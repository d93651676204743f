// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "catalog/shape_record.h"
#include "shape_pipeline/point_cloud.h"
#include "shape_pipeline/rigid_motion.h"

namespace shape_pipeline {

/// A scan from one side.
struct PartialScan {
  std::string name;  // for messages
  PointCloud cloud;
};

/// How two registered parts lie on one another.
struct RegisteredPair {
  std::size_t first = 0, second = 0;
  double overlap = 0;  // share of the second's points that lie on the first's surface
  double rms = 0;      // of their distances from it [m]
};

struct RegisteredParts {
  std::vector<RigidMotion> motions;    // of each part, into the frame of the first
  std::vector<RegisteredPair> pairs;   // those that overlap
  PointCloud merged;                   // in the frame of the first, with outward normals
  std::vector<catalog::Check> checks;  // "registered_parts", "registration_rms", "registration_overlap", and a figure
                                       // each pair
};

/// Brings partial scans of one particle together: attitudes from features (registration/coarse_alignment.h), then
/// closest points, the part that fits best first; at last each part in turn against all others. Throws InputError,
/// naming the part, for less than two parts, sizes that no one particle explains (other units), and a part that does
/// not fit the others.
RegisteredParts register_parts(const std::vector<PartialScan>& parts, std::uint64_t seed = 1);

}  // namespace shape_pipeline
