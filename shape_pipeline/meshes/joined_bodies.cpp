// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/joined_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/hole_filling.h"
#include "shape_pipeline/meshes/solid_union.h"
#include "shape_pipeline/meshes/surface_pieces.h"
#include "shape_pipeline/solid_checks.h"

namespace shape_pipeline {
namespace {

constexpr double kSpeckShare = 0.001;     // of the area: a body of such a surface has 3e-5 of the volume
constexpr double kSpecksTogether = 0.01;  // of the area: more of them are no specks

std::size_t drop_specks(std::vector<SurfacePiece>& pieces) {
  double area = 0, specks = 0;
  for (const SurfacePiece& piece : pieces) area += piece.area;
  const auto is_speck = [&](const SurfacePiece& piece) { return piece.area < kSpeckShare * area; };
  for (const SurfacePiece& piece : pieces) specks += is_speck(piece) ? piece.area : 0;
  return specks <= kSpecksTogether * area ? std::erase_if(pieces, is_speck) : 0;
}

/// The body of largest area with its cavities; roles are found.
std::size_t drop_other_bodies(std::vector<SurfacePiece>& pieces) {
  std::size_t largest = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (pieces[p].role == PieceRole::body && pieces[p].area > pieces[largest].area) largest = p;
  std::size_t p = 0;
  const std::size_t dropped = std::erase_if(pieces, [&](const SurfacePiece& piece) {
    const std::size_t body = piece.role == PieceRole::body ? p : static_cast<std::size_t>(piece.body);
    ++p;
    return body != largest;
  });
  for (SurfacePiece& piece : pieces) piece.body = piece.role == PieceRole::body ? -1 : 0;  // its box is the largest
  return dropped;
}

/// Handles of a surface, of one with holes when they are filled; that there are as many as said is checked of the
/// whole.
int handles(catalog::TriangleMesh mesh) {
  if (mesh_topology(mesh).boundary_edges > 0) fill_holes(mesh);
  return std::max(0, static_cast<int>(1 - mesh_topology(mesh).euler_number / 2));
}

/// The checks of all bodies: numbers of repairs add up, of other figures the worst stays.
class BodyChecks {
 public:
  void add(const std::vector<catalog::Check>& checks) {
    for (const catalog::Check& check : checks) {
      const auto [place, is_new] = places_.try_emplace(check.name, checks_.size());
      if (is_new) {
        checks_.push_back(check);
        continue;
      }
      catalog::Check& kept = checks_[place->second];
      const bool is_count = check.name.starts_with("repair_") && check.name != "repair_alpha_wrap";
      if (is_count) kept.figure += check.figure;
      const bool is_larger = std::abs(check.figure) > std::abs(kept.figure);
      if (!is_count && (kept.passed ? !check.passed || is_larger : !check.passed && is_larger)) kept = check;
    }
  }

  const std::vector<catalog::Check>& all() const { return checks_; }

 private:
  std::vector<catalog::Check> checks_;
  std::map<std::string, std::size_t> places_;
};

/// Checks that are made of the whole, or have no meaning for a piece.
bool is_of_whole(const catalog::Check& check) {
  for (const char* name : {"closed", "one_component", "euler_number", "positive_volume", "volume_hull_ratio",
                           "volume_second_method", "kept_area_share"})
    if (check.name == name) return true;
  return false;
}

/// The repaired pieces as solids, each body with its cavities.
struct Solids {
  std::vector<catalog::TriangleMesh> meshes;
  std::size_t cavities = 0;
  catalog::TriangleMesh before, after;  // all surfaces as they were and as they are
  std::string refusal;
};

Solids repaired_pieces(const std::vector<SurfacePiece>& pieces, const RepairOptions& options, BodyChecks& checks) {
  Solids solids;
  std::vector<std::size_t> solid_of(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const bool is_cavity = pieces[p].role == PieceRole::cavity;
    append(pieces[p].mesh, solids.before);
    catalog::TriangleMesh mesh = pieces[p].mesh;
    if (is_cavity) turn_round(mesh);
    RepairOptions alone = options;
    if (pieces.size() == 1) alone.bodies = catalog::SeparateBodies::refuse;
    if (pieces.size() > 1) alone.genus = handles(mesh);
    RepairedMesh repaired = repaired_surface(cleaned_scan(mesh), alone);
    if (!repaired.refusal.empty()) {
      solids.refusal = "of " + std::to_string(pieces.size()) + " surfaces one cannot be repaired: " + repaired.refusal;
      return solids;
    }
    if (pieces.size() > 1) std::erase_if(repaired.checks, is_of_whole);
    checks.add(repaired.checks);
    if (is_cavity) turn_round(repaired.mesh);
    append(repaired.mesh, solids.after);
    solid_of[p] = is_cavity ? solid_of[static_cast<std::size_t>(pieces[p].body)] : solids.meshes.size();
    if (!is_cavity) solids.meshes.emplace_back();
    append(repaired.mesh, solids.meshes[solid_of[p]]);
    solids.cavities += is_cavity;
  }
  return solids;
}

RepairedMesh refused(const std::string& reason) {
  RepairedMesh result;
  result.refusal = reason;
  return result;
}

}  // namespace

RepairedMesh joined_bodies(CleanedScan scan, const RepairOptions& options) {
  Repair& repair = scan.repair;
  std::vector<SurfacePiece> pieces = surface_pieces(repair.mesh);
  repair.count("dropped_surfaces", drop_specks(pieces), "specks of less than a thousandth of the area dropped");
  if (pieces.size() > kMostSurfaces)
    return refused("the mesh has " + std::to_string(pieces.size()) + " separate surfaces, expected at most " +
                   std::to_string(kMostSurfaces));
  repair.count("turned_surfaces", find_roles(pieces), "surfaces that were inside out turned round");
  if (options.bodies == catalog::SeparateBodies::largest)
    repair.count("dropped_bodies", drop_other_bodies(pieces), "surfaces of other bodies than the largest dropped");

  BodyChecks checks;
  checks.add(repair.checks);
  const Solids solids = repaired_pieces(pieces, options, checks);
  if (!solids.refusal.empty()) return refused(solids.refusal);
  RepairedMesh result;
  result.checks = checks.all();
  SolidUnion whole = union_of_solids(solids.meshes);
  if (!whole.refusal.empty()) return refused(whole.refusal);
  if (pieces.size() > 1) {
    SolidExpectation expectation;
    expectation.genus = options.genus;
    expectation.surfaces = static_cast<int>(mesh_topology(whole.mesh).components);
    expectation.least_hull_ratio = 0;  // bodies far apart fill little of their hull; each was looked at by itself
    const std::vector<catalog::Check> verdict = solid_checks(whole.mesh, expectation);
    if (!all_passed(verdict)) return refused("the bodies together are no right solid (" + failures(verdict) + ")");
    Repair joins;
    joins.checks.push_back(
        {kJoinedBodies, true, static_cast<double>(solids.meshes.size() - whole.united), "bodies taken as one grain"});
    joins.count("united_bodies", whole.united, "bodies that met another made one with it");
    joins.count("touching_bodies", whole.touching, "pairs of faces of bodies that share but edges or corners");
    joins.count("kept_cavities", solids.cavities, "surfaces in a body kept as its cavities");
    result.checks.insert(result.checks.end(), joins.checks.begin(), joins.checks.end());
    result.checks.insert(result.checks.end(), verdict.begin(), verdict.end());
  }
  result.mesh = std::move(whole.mesh);
  RepairedMesh apart;  // what lies in another body is no deviation
  apart.mesh = solids.after;
  add_deviation(solids.before, apart);
  result.checks.insert(result.checks.end(), apart.checks.begin(), apart.checks.end());
  return result;
}

}  // namespace shape_pipeline
