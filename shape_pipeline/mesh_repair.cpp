// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/mesh_repair.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/joined_bodies.h"
#include "shape_pipeline/meshes/surface_pieces.h"
#include "shape_pipeline/meshes/surface_repair.h"

namespace shape_pipeline {
namespace {

RepairedMesh with_deviation(const catalog::TriangleMesh& input, RepairedMesh result) {
  if (result.refusal.empty()) add_deviation(input, result);
  return result;
}

/// The others are left out for good: the deviation is that of the largest surface alone.
RepairedMesh largest_alone(CleanedScan scan, const RepairOptions& options) {
  LargestSurface largest = largest_surface(scan.repair.mesh);
  Repair others{{}, scan.repair.checks};
  others.count("dropped_surfaces", largest.dropped, "separate pieces dropped, the largest surface kept");
  if (largest.dropped > 0)
    others.checks.push_back(
        {"kept_area_share", true, largest.area_share, "area of the largest surface / of all (figure)"});
  RepairedMesh result = with_deviation(largest.mesh, repaired_surface(cleaned_scan(largest.mesh), options));
  result.checks.insert(result.checks.begin(), others.checks.begin(), others.checks.end());
  return result;
}

/// Closed surfaces beside one another, where none stands for the scan.
struct Bodies {
  int count = 0;
  double largest_share = 1;  // of the area
};

Bodies bodies_of(const catalog::TriangleMesh& mesh) {
  std::vector<SurfacePiece> pieces = surface_pieces(mesh);
  double area = 0, largest = 0;
  for (const SurfacePiece& piece : pieces) {
    area += piece.area;
    largest = std::max(largest, piece.area);
  }
  if (pieces.empty() || largest >= kLeastKeptShare * area) return {};
  std::erase_if(pieces, [&](const SurfacePiece& piece) {
    return piece.area < kSpeckShare * area || !mesh_topology(piece.mesh).is_closed();
  });
  if (pieces.size() > kMostSurfaces) return {};
  find_roles(pieces);
  const auto bodies = std::count_if(pieces.begin(), pieces.end(),
                                    [](const SurfacePiece& piece) { return piece.role == PieceRole::body; });
  return {static_cast<int>(bodies), largest / area};
}

/// Bodies that cross are one; such that do not are refused.
RepairedMesh only_body(const catalog::TriangleMesh& scanned, CleanedScan scan, const RepairOptions& options) {
  const Bodies bodies = bodies_of(scan.repair.mesh);
  if (bodies.count < 2) return with_deviation(scanned, repaired_surface(std::move(scan), options));
  RepairedMesh joined = joined_bodies(std::move(scan), options);
  const bool is_one = std::none_of(joined.checks.begin(), joined.checks.end(), [](const catalog::Check& check) {
    return check.name == kJoinedBodies && check.figure > 1;
  });
  if (joined.refusal.empty() && is_one) return joined;
  char line[120];
  std::snprintf(line, sizeof line, "%d separate bodies, the largest with %.1f %% of the area, expected one",
                bodies.count, 100 * bodies.largest_share);
  RepairedMesh result;
  result.refusal = line;
  result.remedy = "take them as one grain with --bodies join, or the largest alone with --bodies largest";
  return result;
}

}  // namespace

RepairedMesh repair_mesh(const catalog::TriangleMesh& scanned, const RepairOptions& options) {
  CleanedScan scan = cleaned_scan(scanned);
  switch (options.bodies) {
    case catalog::SeparateBodies::join:
      return joined_bodies(std::move(scan), options);
    case catalog::SeparateBodies::largest:
      return largest_alone(std::move(scan), options);
    default:
      return only_body(scanned, std::move(scan), options);
  }
}

}  // namespace shape_pipeline
