// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Unit quaternion, body to world. Number: one, or several side by side (RealLanes).
template <class Number>
struct BasicQuaternion {
  Number w{1}, x{}, y{}, z{};
  friend bool operator==(const BasicQuaternion&, const BasicQuaternion&) = default;
};
using Quaternion = BasicQuaternion<Real>;

template <class Number>
TALUS_HD inline BasicQuaternion<Number> operator*(const BasicQuaternion<Number>& a,
                                                  const std::type_identity_t<BasicQuaternion<Number>>& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

TALUS_HD inline Quaternion conjugate(const Quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }

template <class Number = Real>
TALUS_HD inline BasicQuaternion<Number> normalized(const BasicQuaternion<Number>& q) {
  const Number scale = 1 / square_root(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

/// Rotation by `angle` [rad] about the unit `axis`.
TALUS_HD inline Quaternion axis_angle(const Vec3& axis, Real angle) {
  const Real s = std::sin(angle / 2);
  return {std::cos(angle / 2), s * axis.x, s * axis.y, s * axis.z};
}

/// Rotation matrix by its columns: the body axes in the world frame.
template <class Number>
struct BasicMat3 {
  Vector3<Number> column_x{Number{} + 1, {}, {}}, column_y{{}, Number{} + 1, {}}, column_z{{}, {}, Number{} + 1};
};
using Mat3 = BasicMat3<Real>;

template <class Number = Real>
TALUS_HD inline BasicMat3<Number> rotation_matrix(const BasicQuaternion<Number>& q) {
  const Number xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const Number wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{1 - 2 * (yy + zz), 2 * (xy + wz), 2 * (xz - wy)},
          {2 * (xy - wz), 1 - 2 * (xx + zz), 2 * (yz + wx)},
          {2 * (xz + wy), 2 * (yz - wx), 1 - 2 * (xx + yy)}};
}

template <class Number>
TALUS_HD inline Vector3<Number> operator*(const BasicMat3<Number>& m, const std::type_identity_t<Vector3<Number>>& v) {
  return v.x * m.column_x + v.y * m.column_y + v.z * m.column_z;
}
/// Transpose times vector: world to body.
template <class Number>
TALUS_HD inline Vector3<Number> transpose_times(const BasicMat3<Number>& m,
                                                const std::type_identity_t<Vector3<Number>>& v) {
  return {dot(m.column_x, v), dot(m.column_y, v), dot(m.column_z, v)};
}
/// transpose(a) * b: the rotation that takes b's frame into a's.
TALUS_HD inline Mat3 transpose_times(const Mat3& a, const Mat3& b) {
  return {transpose_times(a, b.column_x), transpose_times(a, b.column_y), transpose_times(a, b.column_z)};
}

TALUS_HD inline Vec3 rotate(const Quaternion& q, const Vec3& v) { return rotation_matrix(q) * v; }
TALUS_HD inline Vec3 rotate_back(const Quaternion& q, const Vec3& v) { return transpose_times(rotation_matrix(q), v); }

}  // namespace dem_gpu
