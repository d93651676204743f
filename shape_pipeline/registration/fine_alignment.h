// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/point_cloud.h"
#include "shape_pipeline/rigid_motion.h"
#include "shape_pipeline/surfaces/nearest_points.h"

namespace shape_pipeline {

/// An oriented cloud that others are fitted to.
struct AlignmentTarget {
  explicit AlignmentTarget(PointCloud oriented);

  PointCloud cloud;  // with outward normals
  NearestPoint nearest;
  double spacing = 0;  // average distance to the six nearest points [m]
  double noise = 0;    // standard deviation of the points about the planes through their neighbours, robust [m]
};

/// What a pair of points must keep to count.
struct PairLimits {
  double reach = 0;     // largest distance of the two [m]
  double residual = 0;  // largest distance from the plane, where the biweight falls to zero [m]
};

struct FineAlignment {
  RigidMotion motion;
  int iterations = 0;
};

/// Iterative closest point with the distance from the target's planes (Chen & Medioni 1992), pairs weighted by Tukey's
/// biweight; points whose normal is more than 45 degrees off their partner's do not count.
FineAlignment finely_aligned(const PointCloud& moving, const AlignmentTarget& target, const RigidMotion& start,
                             const PairLimits& limits);

/// How well a moved cloud lies on a target. Of its points some agree (near the target's planes), some contradict (near
/// the target, yet off its planes), the others lie where the target has no points.
struct AlignmentFit {
  double overlap = 0;      // share of points that agree
  double consistency = 0;  // of those that agree or contradict, the share that agree
  double rms = 0;          // distance of those that agree from the planes [m]

  double score() const { return overlap * consistency * consistency; }
};

AlignmentFit alignment_fit(const PointCloud& moving, const AlignmentTarget& target, const RigidMotion& motion);

}  // namespace shape_pipeline
