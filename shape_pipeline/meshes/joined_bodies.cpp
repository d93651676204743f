// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/joined_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/hole_filling.h"
#include "shape_pipeline/meshes/self_intersections.h"
#include "shape_pipeline/meshes/soup_cleaning.h"
#include "shape_pipeline/meshes/surface_pieces.h"
#include "shape_pipeline/meshes/surface_repair.h"
#include "shape_pipeline/meshes/surface_union.h"
#include "shape_pipeline/solid_checks.h"

namespace shape_pipeline {
namespace {

std::size_t drop_specks(std::vector<SurfacePiece>& pieces) {
  double area = 0;
  for (const SurfacePiece& piece : pieces) area += piece.area;
  return std::erase_if(pieces, [&](const SurfacePiece& piece) { return piece.area < kSpeckShare * area; });
}

/// Handles of a surface, of one with holes when they are filled; at most `most`.
int handles(catalog::TriangleMesh mesh, int most) {
  if (mesh_topology(mesh).boundary_edges > 0) fill_holes(mesh);
  return std::clamp(static_cast<int>(1 - mesh_topology(mesh).euler_number / 2), 0, most);
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
      const bool is_worse = kept.passed ? !check.passed || std::abs(check.figure) > std::abs(kept.figure)
                                        : !check.passed && std::abs(check.figure) > std::abs(kept.figure);
      if (!is_count && is_worse) kept = check;
    }
  }

  const std::vector<catalog::Check>& all() const { return checks_; }

 private:
  std::vector<catalog::Check> checks_;
  std::map<std::string, std::size_t> places_;
};

/// Checks that solid_checks() makes of the whole.
bool is_of_whole(const catalog::Check& check) {
  for (const char* name : {"closed", "one_component", "euler_number", "positive_volume", "volume_hull_ratio"})
    if (check.name == name) return true;
  return false;
}

void append(const catalog::TriangleMesh& other, catalog::TriangleMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const catalog::Triangle& face : other.faces)
    mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
}

catalog::TriangleMesh together(const std::vector<catalog::TriangleMesh>& meshes) {
  catalog::TriangleMesh all;
  for (const catalog::TriangleMesh& mesh : meshes) append(mesh, all);
  return all;
}

/// The bodies made one where they cross; with a refusal where that cannot be.
struct Joined {
  catalog::TriangleMesh mesh;
  std::size_t united = 0;  // bodies less surfaces of the result
  std::string refusal;
};

Joined joined(const std::vector<catalog::TriangleMesh>& bodies, const std::vector<catalog::TriangleMesh>& cavities) {
  Joined result;
  catalog::TriangleMesh holes = together(cavities);
  result.mesh = together(bodies);
  append(holes, result.mesh);
  if (count_self_intersections(result.mesh) == 0) return result;
  std::optional<catalog::TriangleMesh> whole = united(bodies);
  if (whole) {
    put_in_canonical_order(*whole);
    const std::size_t left = mesh_topology(*whole).components;
    result.united = bodies.size() - std::min(left, bodies.size());
    append(holes, *whole);
  }
  if (!whole || !mesh_topology(*whole).is_closed() || count_self_intersections(*whole) > 0)
    result.refusal = "its bodies cut or touch one another and cannot be united";
  else
    result.mesh = std::move(*whole);
  return result;
}

}  // namespace

RepairedMesh joined_bodies(CleanedScan scan, const RepairOptions& options) {
  Repair& repair = scan.repair;
  std::vector<SurfacePiece> pieces = surface_pieces(repair.mesh);
  repair.count("dropped_surfaces", drop_specks(pieces), "specks of less than a thousandth of the area dropped");
  RepairedMesh result;
  if (pieces.size() > kMostSurfaces) {
    result.refusal = "the mesh has " + std::to_string(pieces.size()) + " separate surfaces, expected at most " +
                     std::to_string(kMostSurfaces);
    return result;
  }
  repair.count("turned_surfaces", find_roles(pieces), "surfaces that were inside out turned round");
  repair.count("inner_surfaces",
               std::erase_if(pieces, [](const SurfacePiece& piece) { return piece.role == PieceRole::inner; }),
               "surfaces in a body that bound nothing dropped");

  BodyChecks checks;
  checks.add(repair.checks);
  std::vector<catalog::TriangleMesh> bodies, cavities, kept;
  for (SurfacePiece& piece : pieces) {
    kept.push_back(piece.mesh);
    if (piece.role == PieceRole::cavity) turn_round(piece.mesh);
    RepairOptions alone = options;
    alone.genus = handles(piece.mesh, options.genus);
    RepairedMesh repaired = repaired_surface(cleaned_scan(piece.mesh), alone);
    if (!repaired.refusal.empty()) {
      result.refusal = "of " + std::to_string(pieces.size()) + " surfaces one cannot be repaired: " + repaired.refusal;
      return result;
    }
    if (pieces.size() > 1) std::erase_if(repaired.checks, is_of_whole);
    checks.add(repaired.checks);
    if (piece.role == PieceRole::cavity) turn_round(repaired.mesh);
    (piece.role == PieceRole::cavity ? cavities : bodies).push_back(std::move(repaired.mesh));
  }
  result.checks = checks.all();
  Joined whole = joined(bodies, cavities);
  if (!whole.refusal.empty()) {
    result.refusal = whole.refusal;
    return result;
  }
  if (pieces.size() > 1) {
    SolidExpectation expectation;
    expectation.genus = options.genus;
    expectation.surfaces = static_cast<int>(mesh_topology(whole.mesh).components);
    expectation.least_hull_ratio = 0;  // bodies far apart fill little of their hull; each was looked at by itself
    const std::vector<catalog::Check> verdict = solid_checks(whole.mesh, expectation);
    if (!all_passed(verdict)) {
      result.refusal = "the bodies together are no right solid (" + failures(verdict) + ")";
      return result;
    }
    Repair joins;
    joins.checks.push_back(
        {kJoinedBodies, true, static_cast<double>(bodies.size() - whole.united), "bodies taken as one grain"});
    joins.count("united_bodies", whole.united, "bodies that crossed another made one with it");
    joins.count("kept_cavities", cavities.size(), "surfaces in a body kept as its cavities");
    result.checks.insert(result.checks.end(), joins.checks.begin(), joins.checks.end());
    result.checks.insert(result.checks.end(), verdict.begin(), verdict.end());
  }
  result.mesh = std::move(whole.mesh);
  RepairedMesh apart;  // what is in another body is no deviation
  apart.mesh = together(bodies);
  append(together(cavities), apart.mesh);
  add_deviation(together(kept), apart);
  result.checks.insert(result.checks.end(), apart.checks.begin(), apart.checks.end());
  return result;
}

}  // namespace shape_pipeline
