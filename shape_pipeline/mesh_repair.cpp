// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/mesh_repair.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/hole_filling.h"
#include "shape_pipeline/meshes/joined_bodies.h"
#include "shape_pipeline/meshes/self_intersections.h"
#include "shape_pipeline/meshes/surface_pieces.h"
#include "shape_pipeline/meshes/surface_repair.h"

namespace shape_pipeline {
namespace {

constexpr double kLargeShare = 0.1;  // of the area: ten surfaces at most are as large

RepairedMesh with_deviation(const catalog::TriangleMesh& input, RepairedMesh result) {
  if (result.refusal.empty()) add_deviation(input, result);
  return result;
}

/// What there is beside the largest surface, where that does not stand for the scan.
struct OtherSurfaces {
  std::size_t bodies = 1, cavities = 0;  // closed, or nearly
  double largest_share = 1;              // of the area
  bool do_meet = false;                  // some of the bodies
};

/// Whether a surface with holes is a body all the same: its patches would be small. Torn sheets are none.
bool is_nearly_closed(const SurfacePiece& piece) {
  if (mesh_topology(piece.mesh).is_closed()) return true;
  catalog::TriangleMesh filled = piece.mesh;
  return fill_holes(filled).filled_area <= kLargestFilledShare * piece.area && mesh_topology(filled).is_closed();
}

/// Whether some surfaces cross or touch, or a body lies in another.
bool do_meet(const std::vector<SurfacePiece>& pieces) {
  catalog::TriangleMesh all;
  for (const SurfacePiece& piece : pieces) {
    if (piece.is_nested) return true;
    append(piece.mesh, all);
  }
  const std::vector<int> surface = face_components(all);
  const auto pairs = self_intersecting_faces(all);
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const auto& pair) { return surface[pair.first] != surface[pair.second]; });
}

OtherSurfaces other_surfaces(const catalog::TriangleMesh& mesh) {
  std::vector<SurfacePiece> pieces = surface_pieces(mesh);
  double area = 0, largest = 0;
  for (const SurfacePiece& piece : pieces) {
    area += piece.area;
    largest = std::max(largest, piece.area);
  }
  if (pieces.empty() || largest >= kLeastKeptShare * area) return {};
  OtherSurfaces others;
  others.largest_share = largest / area;
  // Few can be large; many small ones are bodies if they came closed.
  std::erase_if(pieces, [&](const SurfacePiece& piece) {
    return piece.area < kLargeShare * area ? !mesh_topology(piece.mesh).is_closed() : !is_nearly_closed(piece);
  });
  if (pieces.size() > kMostSurfaces) {
    others.bodies = pieces.size();
    return others;
  }
  find_roles(pieces);
  const auto cavities = std::count_if(pieces.begin(), pieces.end(),
                                      [](const SurfacePiece& piece) { return piece.role == PieceRole::cavity; });
  others.cavities = static_cast<std::size_t>(cavities);
  others.bodies = std::max<std::size_t>(1, pieces.size() - others.cavities);
  others.do_meet = do_meet(pieces);
  return others;
}

RepairedMesh refused_others(const OtherSurfaces& others) {
  char line[120];
  RepairedMesh result;
  if (others.bodies > 1) {
    std::snprintf(line, sizeof line, "%zu separate bodies, the largest surface with %.1f %% of the area, expected one",
                  others.bodies, 100 * others.largest_share);
    result.remedy = "take them as one grain with --bodies join, or the largest alone with --bodies largest";
  } else {
    std::snprintf(line, sizeof line, "a body with cavities (%zu), its largest surface with %.1f %% of the area",
                  others.cavities, 100 * others.largest_share);
    result.remedy = "keep them hollow with --bodies join, or take them out of the scan";
  }
  result.refusal = line;
  return result;
}

/// Bodies that meet are one; such that do not are refused, and so are large cavities.
RepairedMesh only_body(const catalog::TriangleMesh& scanned, CleanedScan scan, const RepairOptions& options) {
  const OtherSurfaces others = other_surfaces(scan.repair.mesh);
  if (others.bodies == 1 && others.cavities == 0)
    return with_deviation(scanned, repaired_surface(std::move(scan), options));
  if (others.bodies == 1 || !others.do_meet) return refused_others(others);
  RepairedMesh joined = joined_bodies(std::move(scan), options);
  const auto count = std::find_if(joined.checks.begin(), joined.checks.end(),
                                  [](const catalog::Check& check) { return check.name == kJoinedBodies; });
  const bool is_one = joined.refusal.empty() && (count == joined.checks.end() || count->figure == 1);
  const bool is_several = joined.refusal.empty() && !is_one;
  return is_several ? refused_others(others) : joined;
}

/// All bodies, or the largest; where that cannot be done, the largest surface if it stands for the scan.
RepairedMesh chosen_bodies(const catalog::TriangleMesh& scanned, CleanedScan scan, const RepairOptions& options) {
  RepairedMesh joined = joined_bodies(scan, options);
  if (joined.refusal.empty() || largest_surface(scan.repair.mesh).area_share < kLeastKeptShare) return joined;
  RepairedMesh alone = with_deviation(scanned, repaired_surface(std::move(scan), options));
  if (!alone.refusal.empty()) return joined;
  alone.checks.push_back({kJoinedBodies, false, 0, joined.refusal + "; the largest surface alone taken"});
  return alone;
}

}  // namespace

RepairedMesh repair_mesh(const catalog::TriangleMesh& scanned, const RepairOptions& options) {
  CleanedScan scan = cleaned_scan(scanned);
  return options.bodies == catalog::SeparateBodies::refuse ? only_body(scanned, std::move(scan), options)
                                                           : chosen_bodies(scanned, std::move(scan), options);
}

}  // namespace shape_pipeline
