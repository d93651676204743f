// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// A step from a periodic box to one beside it: -1, 0 or 1 box lengths along x, y, z.
struct LatticeStep {
  int x = 0, y = 0, z = 0;

  TALUS_HD friend LatticeStep operator+(const LatticeStep& a, const LatticeStep& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  TALUS_HD friend LatticeStep operator-(const LatticeStep& a, const LatticeStep& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  /// Does it lead to the box itself or one that touches it?
  TALUS_HD bool is_single() const { return x * x <= 1 && y * y <= 1 && z * z <= 1; }
  TALUS_HD bool is_none() const { return x == 0 && y == 0 && z == 0; }
};

// Single steps as one number.
inline constexpr int kLatticeSteps = 27;
TALUS_HD inline int code_of(const LatticeStep& step) { return 9 * (step.x + 1) + 3 * (step.y + 1) + step.z + 1; }
TALUS_HD inline LatticeStep lattice_step(int code) { return {code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1}; }

/// The boxes that a periodic scene is made of. Along an axis that is not periodic the box is endless and its length 0.
struct PeriodicLattice {
  Vec3 low, high, length;  // [m]

  TALUS_HD Vec3 shift(const LatticeStep& step) const {
    return {step.x * length.x, step.y * length.y, step.z * length.z};
  }
  /// May a step be taken: does it keep to the periodic axes?
  TALUS_HD bool has(const LatticeStep& step) const {
    return (step.x == 0 || length.x > 0) && (step.y == 0 || length.y > 0) && (step.z == 0 || length.z > 0);
  }
  /// The step from the box to where x lies; x no further out than one length.
  TALUS_HD LatticeStep step_to(const Vec3& x) const {
    return {side(x.x, low.x, high.x), side(x.y, low.y, high.y), side(x.z, low.z, high.z)};
  }
  /// The same place in the box itself, rounding included: low <= result < high.
  TALUS_HD Vec3 inside(const Vec3& x) const {
    return {inside(x.x, low.x, high.x, length.x), inside(x.y, low.y, high.y, length.y),
            inside(x.z, low.z, high.z, length.z)};
  }
  /// Is x in the box, or no further than `margin` beyond a face?
  TALUS_HD bool is_near(const Vec3& x, Real margin) const {
    return x.x >= low.x - margin && x.x <= high.x + margin && x.y >= low.y - margin && x.y <= high.y + margin &&
           x.z >= low.z - margin && x.z <= high.z + margin;
  }

 private:
  TALUS_HD static int side(Real x, Real low, Real high) { return x < low ? -1 : x >= high ? 1 : 0; }
  TALUS_HD static Real inside(Real x, Real low, Real high, Real length) {
    if (x < low) return std::min(x + length, std::nextafter(high, low));
    return x >= high ? std::max(x - length, low) : x;
  }
};

}  // namespace dem_gpu
