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
  TALUS_HD const RealLaneVec3& to(const RealLaneVec3& x) const { return x; }
  TALUS_HD const Vec3& first_about_centre(const Vec3& moment, Real /*weight*/) const { return moment; }
  TALUS_HD Real second_about_centre(Real second, const Vec3& /*moment*/, Real /*weight*/) const { return second; }
};

template <>
struct BasicMomentOrigin<float> {
  Vector3<float> corner;

  TALUS_HD static BasicMomentOrigin at(const Vector3<float>& corner) { return {corner}; }
  /// From the origin to x.
  TALUS_HD Vector3<float> to(const Vector3<float>& x) const { return x - corner; }
  template <class FloatLanes>
  TALUS_HD LaneVector<FloatLanes> to(const LaneVector<FloatLanes>& x) const {
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
};

using MomentOrigin = BasicMomentOrigin<LocalReal>;

}  // namespace dem_gpu
