// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/lanes.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Eight vectors, one array a coordinate.
template <class SomeLanes>
struct LaneVector {
  SomeLanes x, y, z;

  TALUS_HD LaneVector& operator+=(const LaneVector& b) { return x += b.x, y += b.y, z += b.z, *this; }
};
using LaneVec3 = LaneVector<Lanes>;
using WideLaneVec3 = LaneVector<WideLanes>;

template <class SomeLanes>
TALUS_HD LaneVector<SomeLanes> operator+(const LaneVector<SomeLanes>& a, const LaneVector<SomeLanes>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class SomeLanes>
TALUS_HD LaneVector<SomeLanes> operator-(const LaneVector<SomeLanes>& a, const LaneVector<SomeLanes>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class SomeLanes>
TALUS_HD LaneVector<SomeLanes> operator*(const SomeLanes& s, const LaneVector<SomeLanes>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
/// One factor for all, of the lanes' own number type.
template <class SomeLanes>
TALUS_HD LaneVector<SomeLanes> operator*(decltype(SomeLanes{}[0] + 0) s, const LaneVector<SomeLanes>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class SomeLanes>
TALUS_HD SomeLanes dot(const LaneVector<SomeLanes>& a, const LaneVector<SomeLanes>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// One vector with each of eight.
template <class Scalar, class SomeLanes>
TALUS_HD SomeLanes dot(const Vector3<Scalar>& a, const LaneVector<SomeLanes>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class SomeLanes>
TALUS_HD LaneVector<SomeLanes> cross(const LaneVector<SomeLanes>& a, const LaneVector<SomeLanes>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class SomeLanes>
TALUS_HD SomeLanes norm_squared(const LaneVector<SomeLanes>& a) {
  return dot(a, a);
}
template <class Scalar, class SomeLanes>
TALUS_HD LaneVector<SomeLanes> operator-(const LaneVector<SomeLanes>& a, const Vector3<Scalar>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

TALUS_HD inline LaneVec3 in_order(const LaneVec3& a, const LaneIndex& index) {
  return {in_order(a.x, index), in_order(a.y, index), in_order(a.z, index)};
}
TALUS_HD inline LaneVec3 next_lane(const LaneVec3& a) { return {next_lane(a.x), next_lane(a.y), next_lane(a.z)}; }
TALUS_HD inline LaneVec3 first_lane(const LaneVec3& a) { return {first_lane(a.x), first_lane(a.y), first_lane(a.z)}; }
TALUS_HD inline WideLaneVec3 widened(const LaneVec3& a) { return {widened(a.x), widened(a.y), widened(a.z)}; }
TALUS_HD inline LaneVec3 rounded(const WideLaneVec3& a) { return {rounded(a.x), rounded(a.y), rounded(a.z)}; }
template <class SomeLanes>
TALUS_HD auto sum_of_lanes(const LaneVector<SomeLanes>& a) {
  using Scalar = decltype(sum_of_lanes(a.x));
  return Vector3<Scalar>{sum_of_lanes(a.x), sum_of_lanes(a.y), sum_of_lanes(a.z)};
}
TALUS_HD inline LocalVec3 lane(const LaneVec3& a, int i) { return {a.x[i], a.y[i], a.z[i]}; }

}  // namespace dem_gpu
