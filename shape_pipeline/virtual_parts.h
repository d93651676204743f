// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/registration.h"

namespace shape_pipeline {

/// Scans of one solid of which each misses a part, turned and shifted at random.
struct VirtualParts {
  std::vector<PartialScan> parts;  // "part1.ply", ...
  std::vector<RigidMotion> truth;  // of each, into the frame of the first
  catalog::Point centre{};         // of the solid's origin in the frame of the first [m]
  double diagonal = 0;             // of the solid [m]
};

/// Each part misses a cap of 35 % of all directions, somewhere; `noise` is the standard deviation [m] of the 6000
/// points of a whole scan.
VirtualParts virtual_parts(const catalog::TriangleMesh& mesh, int count, std::uint64_t seed, double noise);

/// The part that is farthest off.
struct PoseError {
  double rotation = 0;  // [rad]
  double shift = 0;     // of the solid's origin / diagonal
};
PoseError worst_pose_error(const RegisteredParts& found, const VirtualParts& known);

/// Rocks in a row on a tilted plate, scanned from above: points that look down by more than 60 degrees are hidden.
struct VirtualPlate {
  PointCloud cloud;
  std::vector<double> volumes;  // of the rocks [m3]
  catalog::Point normal{};      // of the plate, towards the rocks
  std::size_t plate_points = 0;
};
VirtualPlate virtual_plate(int rocks, int points_each, double noise);

}  // namespace shape_pipeline
