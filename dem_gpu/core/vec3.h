// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

namespace dem_gpu {

struct Vec3 {
  Real x = 0, y = 0, z = 0;

  TALUS_HD Vec3& operator+=(const Vec3& b) { return x += b.x, y += b.y, z += b.z, *this; }
  TALUS_HD Vec3& operator-=(const Vec3& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  TALUS_HD Vec3& operator*=(Real s) { return x *= s, y *= s, z *= s, *this; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

TALUS_HD inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
TALUS_HD inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
TALUS_HD inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
TALUS_HD inline Vec3 operator*(Real s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
TALUS_HD inline Vec3 operator*(const Vec3& a, Real s) { return s * a; }
TALUS_HD inline Vec3 operator/(const Vec3& a, Real s) { return (1 / s) * a; }

TALUS_HD inline Real dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
TALUS_HD inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
TALUS_HD inline Vec3 hadamard(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
TALUS_HD inline Real norm_squared(const Vec3& a) { return dot(a, a); }
TALUS_HD inline Real norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// a / |a|, or `fallback` where a is zero.
TALUS_HD inline Vec3 unit_or(const Vec3& a, const Vec3& fallback) {
  const Real length = norm(a);
  return length > 0 ? a / length : fallback;
}

/// Some unit vector at right angles to the unit vector n.
TALUS_HD inline Vec3 any_perpendicular(const Vec3& n) {
  const Vec3 trial = std::abs(n.x) < Real(0.6) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 side = cross(n, trial);
  return side / norm(side);
}

}  // namespace dem_gpu
