// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/lane_vec3.h"

namespace dem_gpu {

/// Point about which the moments of one piece of surface are summed in the precision of contact geometry. In double
/// precision it is the body's centre and costs nothing. In single precision it is a corner of the piece: about the
/// centre, the second moment of a small patch would be lost in rounding (6e-8 of its distance squared).
template <class Scalar>
struct BasicMomentOrigin;

template <>
struct BasicMomentOrigin<Real> {
  TALUS_HD static BasicMomentOrigin at(const Vec3& /*corner*/) { return {}; }
  TALUS_HD const Vec3& to(const Vec3& x) const { return x; }
  TALUS_HD const WideLaneVec3& to(const WideLaneVec3& x) const { return x; }
  TALUS_HD const Vec3& first_about_centre(const Vec3& moment, Real /*weight*/) const { return moment; }
  TALUS_HD Real second_about_centre(Real second, const Vec3& /*moment*/, Real /*weight*/) const { return second; }
  TALUS_HD const WideLaneVec3& first_about_centre(const WideLaneVec3& moment, const WideLanes& /*weight*/) const {
    return moment;
  }
  TALUS_HD const WideLanes& second_about_centre(const WideLanes& second, const WideLaneVec3& /*moment*/,
                                                const WideLanes& /*weight*/) const {
    return second;
  }
};

template <>
struct BasicMomentOrigin<float> {
  Vector3<float> corner;

  TALUS_HD static BasicMomentOrigin at(const Vector3<float>& corner) { return {corner}; }
  /// From the origin to x.
  TALUS_HD Vector3<float> to(const Vector3<float>& x) const { return x - corner; }
  template <class FloatLanes>
  TALUS_HD Vector3<FloatLanes> to(const Vector3<FloatLanes>& x) const {
    return x - corner;
  }
  /// Moments about the body's centre from `weight` (integral of w dA) and the moments about the origin.
  TALUS_HD Vec3 first_about_centre(const Vector3<float>& moment, float weight) const {
    return Vec3(moment) + Real(weight) * Vec3(corner);
  }
  TALUS_HD Real second_about_centre(float second, const Vector3<float>& moment, float weight) const {
    const Vec3 centre_to_origin = corner;
    return second + 2 * dot(centre_to_origin, moment) + norm_squared(centre_to_origin) * weight;
  }
  TALUS_HD WideLaneVec3 first_about_centre(const LaneVec3& moment, const Lanes& weight) const {
    const WideLanes w = widened(weight);
    const WideLaneVec3 about_origin = widened(moment);
    const Vec3 c = corner;
    return {about_origin.x + c.x * w, about_origin.y + c.y * w, about_origin.z + c.z * w};
  }
  TALUS_HD WideLanes second_about_centre(const Lanes& second, const LaneVec3& moment, const Lanes& weight) const {
    const Vec3 c = corner;
    return widened(second) + 2 * dot(c, widened(moment)) + norm_squared(c) * widened(weight);
  }
};

using MomentOrigin = BasicMomentOrigin<LocalReal>;

}  // namespace dem_gpu
