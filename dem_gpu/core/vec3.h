// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <type_traits>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"
#include "dem_gpu/core/real_lanes.h"

namespace dem_gpu {

template <class Scalar>
struct Vector3 {
  Scalar x{}, y{}, z{};

  TALUS_HD Vector3& operator+=(const Vector3& b) { return x += b.x, y += b.y, z += b.z, *this; }
  TALUS_HD Vector3& operator-=(const Vector3& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  TALUS_HD Vector3& operator*=(Scalar s) { return x *= s, y *= s, z *= s, *this; }
  friend bool operator==(const Vector3&, const Vector3&) = default;

  /// Widening loses nothing, so it needs no word; narrowing is `rounded`.
  template <class Wide>
  requires(sizeof(Wide) > sizeof(Scalar)) TALUS_HD operator Vector3<Wide>() const { return {x, y, z}; }
};

using Vec3 = Vector3<Real>;
using LocalVec3 = Vector3<LocalReal>;

/// A factor of any arithmetic type takes the vector's precision.
template <class Scalar>
using Factor = std::type_identity_t<Scalar>;

template <class Scalar>
TALUS_HD inline Vector3<Scalar> operator+(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Scalar>
TALUS_HD inline Vector3<Scalar> operator-(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Scalar>
TALUS_HD inline Vector3<Scalar> operator-(const Vector3<Scalar>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class Scalar>
TALUS_HD inline Vector3<Scalar> operator*(Factor<Scalar> s, const Vector3<Scalar>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Scalar>
TALUS_HD inline Vector3<Scalar> operator*(const Vector3<Scalar>& a, Factor<Scalar> s) {
  return s * a;
}
template <class Scalar>
TALUS_HD inline Vector3<Scalar> operator/(const Vector3<Scalar>& a, Factor<Scalar> s) {
  return (1 / s) * a;
}

template <class Scalar>
TALUS_HD inline Scalar dot(const Vector3<Scalar>& a, const std::type_identity_t<Vector3<Scalar>>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Scalar>
TALUS_HD inline Vector3<Scalar> cross(const Vector3<Scalar>& a, const std::type_identity_t<Vector3<Scalar>>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Scalar>
TALUS_HD inline Vector3<Scalar> hadamard(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class Scalar>
TALUS_HD inline Scalar norm_squared(const Vector3<Scalar>& a) {
  return dot(a, a);
}
template <class Scalar>
TALUS_HD inline Scalar norm(const Vector3<Scalar>& a) {
  return square_root(dot(a, a));
}

/// `is_first`: as select of numbers takes it.
template <class Mask, class Scalar>
TALUS_HD inline Vector3<Scalar> select(const Mask& is_first, const Vector3<Scalar>& first,
                                       const std::type_identity_t<Vector3<Scalar>>& second) {
  return {select(is_first, first.x, second.x), select(is_first, first.y, second.y),
          select(is_first, first.z, second.z)};
}

/// a / |a|, or `fallback` where a is zero.
template <class Scalar>
TALUS_HD inline Vector3<Scalar> unit_or(const Vector3<Scalar>& a,
                                        const std::type_identity_t<Vector3<Scalar>>& fallback) {
  const Scalar length = norm(a);
  return length > 0 ? a / length : fallback;
}

/// Some unit vector at right angles to the unit vector n.
template <class Scalar>
TALUS_HD inline Vector3<Scalar> any_perpendicular(const Vector3<Scalar>& n) {
  const Vector3<Scalar> trial = std::abs(n.x) < Scalar(0.6) ? Vector3<Scalar>{1, 0, 0} : Vector3<Scalar>{0, 1, 0};
  const Vector3<Scalar> side = cross(n, trial);
  return side / norm(side);
}

/// To the precision of contact geometry. In a double build values are passed on as they are, not rebuilt member by
/// member: the compiler then moves them in vector registers as it does elsewhere (a third of a run with a drum).
TALUS_HD inline LocalReal rounded(Real a) { return static_cast<LocalReal>(a); }
TALUS_HD inline const LocalVec3& rounded(const LocalVec3& a) { return a; }
template <class Wide>
requires(sizeof(Wide) > sizeof(LocalReal)) TALUS_HD inline LocalVec3 rounded(const Vector3<Wide>& a) {
  return {static_cast<LocalReal>(a.x), static_cast<LocalReal>(a.y), static_cast<LocalReal>(a.z)};
}

}  // namespace dem_gpu
