// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "dem_gpu/core/real_lanes.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Coulomb friction with a tangential spring. Cundall & Strack, Geotechnique 29 (1979) 47-65. The spring follows the
/// contact plane as it turns. Number: one contact, or several side by side.
template <class Number>
struct TangentialSprings {
  Vector3<Number> displacement;  // in: last step; out: this step [m]
  Number stiffness;              // [N/m]
  Number damping;                // [N s/m]

  /// `kept`: square of the share of its length that the spring keeps from the last step.
  TALUS_HD Vector3<Number> force(const Vector3<Number>& normal, const Vector3<Number>& mean_slip,
                                 const Vector3<Number>& predicted_slip, Real time_step, const Number& limit,
                                 const Number& kept = Number{} + Real(1)) {
    const Number one = Number{} + Real(1), length = norm_squared(displacement);
    displacement -= dot(displacement, normal) * normal;
    const Number turned = norm_squared(displacement);
    displacement = select(turned > Real(0), square_root(kept * length / turned), one) * displacement;
    displacement += (Number{} + time_step) * mean_slip;
    const Vector3<Number> drag = damping * predicted_slip;
    Vector3<Number> trial = -stiffness * displacement - drag;
    const Number size = norm(trial);
    const auto slides = size > limit;
    if (bits_of(slides) == 0) return trial;
    // The spring gives way: what is left of it balances the limit.
    trial = select(slides, limit / size, one) * trial;
    const Vector3<Number> left = trial + drag;
    const Number load = norm(left);
    const Number share = select(stiffness * load > Real(0), -smaller(load, limit) / (stiffness * load), Number{});
    displacement = {select(slides, share * left.x, displacement.x), select(slides, share * left.y, displacement.y),
                    select(slides, share * left.z, displacement.z)};
    return trial;
  }
};

using TangentialSpring = TangentialSprings<Real>;

}  // namespace dem_gpu
