// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Coulomb friction with a tangential spring. Cundall & Strack, Geotechnique 29 (1979) 47-65. The spring follows the
/// contact plane as it turns.
struct TangentialSpring {
  Vec3 displacement;  // in: last step; out: this step [m]
  Real stiffness;     // [N/m]
  Real damping;       // [N s/m]

  TALUS_HD Vec3 force(const Vec3& normal, const Vec3& mean_slip, const Vec3& predicted_slip, Real time_step,
                      Real limit) {
    const Real length = norm(displacement);
    displacement -= dot(displacement, normal) * normal;
    const Real turned = norm(displacement);
    if (turned > 0) displacement *= length / turned;
    displacement += time_step * mean_slip;
    Vec3 trial = -stiffness * displacement - damping * predicted_slip;
    const Real magnitude = norm(trial);
    if (magnitude > limit) {
      trial *= limit / magnitude;
      // The spring gives way: what is left of it balances the limit.
      displacement = stiffness > 0 ? (-1 / stiffness) * (trial + damping * predicted_slip) : Vec3{};
      const Real left = stiffness * norm(displacement);
      if (left > limit) displacement *= limit / left;
    }
    return trial;
  }
};

}  // namespace dem_gpu
