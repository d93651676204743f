// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "shape_pipeline/registration/fine_alignment.h"
#include "shape_pipeline/registration/point_features.h"

namespace shape_pipeline {

/// A cloud of few points with their features, for finding attitudes.
struct FeaturedCloud {
  explicit FeaturedCloud(const PointCloud& oriented);

  AlignmentTarget target;
  std::vector<PointFeature> features;
};

struct Attitude {
  RigidMotion motion;
  AlignmentFit fit;
};

/// Attitudes of one cloud on another, the best first, from nothing but their shapes. Sample consensus: two points and
/// the two of the other cloud whose features are alike, where distance and normals of the pairs agree (as in Drost et
/// al. 2010), give a motion; the best that differ are refined by closest points. Seeded: the same on every call.
std::vector<Attitude> coarse_attitudes(const FeaturedCloud& moving, const FeaturedCloud& fixed, std::uint64_t seed);

}  // namespace shape_pipeline
