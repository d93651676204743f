// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "dem_gpu/core/lanes.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Eight vectors, one register a coordinate.
using LaneVec3 = Vector3<Lanes>;
using WideLaneVec3 = Vector3<WideLanes>;

template <class Number>
concept SingleNumber = std::is_floating_point_v<Number>;
template <class Number>
concept ManyNumbers = !std::is_floating_point_v<Number>;

/// One vector with each of eight.
template <SingleNumber Scalar, ManyNumbers SomeLanes>
TALUS_HD SomeLanes dot(const Vector3<Scalar>& a, const Vector3<SomeLanes>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <SingleNumber Scalar, ManyNumbers SomeLanes>
TALUS_HD Vector3<SomeLanes> operator-(const Vector3<SomeLanes>& a, const Vector3<Scalar>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
/// One factor for all, of the lanes' own number type.
template <ManyNumbers SomeLanes>
TALUS_HD Vector3<SomeLanes> operator*(std::remove_cvref_t<decltype(SomeLanes{}[0])> s, const Vector3<SomeLanes>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

TALUS_HD inline LaneVec3 in_order(const LaneVec3& a, const LaneIndex& index) {
  return {in_order(a.x, index), in_order(a.y, index), in_order(a.z, index)};
}
TALUS_HD inline LaneVec3 next_lane(const LaneVec3& a) { return {next_lane(a.x), next_lane(a.y), next_lane(a.z)}; }
TALUS_HD inline LaneVec3 first_lane(const LaneVec3& a) { return {first_lane(a.x), first_lane(a.y), first_lane(a.z)}; }
TALUS_HD inline WideLaneVec3 widened(const LaneVec3& a) { return {widened(a.x), widened(a.y), widened(a.z)}; }
TALUS_HD inline LaneVec3 rounded(const WideLaneVec3& a) { return {rounded(a.x), rounded(a.y), rounded(a.z)}; }
template <ManyNumbers SomeLanes>
TALUS_HD auto sum_of_lanes(const Vector3<SomeLanes>& a) {
  using Scalar = decltype(sum_of_lanes(a.x));
  return Vector3<Scalar>{sum_of_lanes(a.x), sum_of_lanes(a.y), sum_of_lanes(a.z)};
}
/// One of the eight.
TALUS_HD inline LocalVec3 point_at(const LaneVec3& a, int i) { return {a.x[i], a.y[i], a.z[i]}; }

}  // namespace dem_gpu
