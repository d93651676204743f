// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "shape_pipeline/mesh_repair.h"

namespace shape_pipeline {

inline constexpr double kLeastKeptShare = 0.9;  // of the area that the largest surface must have to stand for the scan
inline constexpr double kLargestFilledShare = 0.2;  // of the area: more than this is invention, not repair

/// The steps so far, with the mesh in work.
struct Repair {
  catalog::TriangleMesh mesh;
  std::vector<catalog::Check> checks;

  /// Adds the check "repair_NAME" unless the number is 0.
  void count(const std::string& name, std::size_t number, const std::string& detail);
};

/// A scan with its vertices welded, faces without area and double ones removed, and the rest turned alike.
struct CleanedScan {
  Repair repair;
  catalog::TriangleMesh unturned;  // as the scanner turned the faces
  bool was_closed = false;         // before the turning
};

CleanedScan cleaned_scan(const catalog::TriangleMesh& scanned);

/// One surface, the largest, as a right solid, see repair_mesh(); without the deviation.
RepairedMesh repaired_surface(CleanedScan scan, const RepairOptions& options);

/// How far the input's surface lies from the result: mean, 95 % and largest distance over the input's diagonal.
void add_deviation(const catalog::TriangleMesh& input, RepairedMesh& result);

}  // namespace shape_pipeline
