// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/overlap_probe.h"

namespace workflows {

/// Overlap integrals of two convex bodies of one part each, written down as plainly as the formulas: every face of one
/// clipped by every plane of the other, one number at a time, nothing cached and nothing skipped. What the engine's
/// speed is measured against.
class PlainOverlap {
 public:
  PlainOverlap(const dem_gpu::Shape& a, const dem_gpu::Shape& b);

  struct Sums {
    double volume = 0;     // [m3]
    dem_gpu::Vec3 area;    // vector area of a's surface inside b [m2]
    dem_gpu::Vec3 moment;  // of the same, x cross n dA about a's origin [m3]
  };
  /// In a's frame; scales are 1.
  Sums sums(const dem_gpu::PosePair& poses) const;

 private:
  catalog::ConvexPart a_, b_;
};

}  // namespace workflows
