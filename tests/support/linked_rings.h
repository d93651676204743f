// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "dem_gpu/core/quaternion.h"

namespace test_support {

using dem_gpu::Quaternion;
using dem_gpu::Real;
using dem_gpu::Vec3;

/// Centreline of a ring at a pose, as a closed polygon. `normal`: its axis in the body frame.
inline std::vector<Vec3> ring_centreline(Real diameter, const Vec3& position, const Quaternion& turn,
                                         const Vec3& normal) {
  constexpr int kPoints = 72;
  const Vec3 u = dem_gpu::any_perpendicular(normal), v = cross(normal, u);
  std::vector<Vec3> line;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * M_PI * i / kPoints;
    line.push_back(position + diameter / 2 * rotate(turn, std::cos(angle) * u + std::sin(angle) * v));
  }
  return line;
}

/// Gauss linking number of two closed polygons: sum of the solid angles of their pairs of segments over 4 pi (Banchoff,
/// Indiana Univ. Math. J. 25 (1976) 1171). Whole but for rounding.
inline double linking_number(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec3 &a0 = a[i], &a1 = a[(i + 1) % a.size()], &b0 = b[j], &b1 = b[(j + 1) % b.size()];
      const Vec3 r[] = {b0 - a0, b0 - a1, b1 - a1, b1 - a0};
      const auto triangle = [](const Vec3& x, const Vec3& y, const Vec3& z) {  // van Oosterom & Strackee 1983
        const double p = norm(x), q = norm(y), s = norm(z);
        return 2 * std::atan2(dot(x, cross(y, z)), p * q * s + dot(x, y) * s + dot(y, z) * p + dot(z, x) * q);
      };
      sum += triangle(r[0], r[1], r[2]) + triangle(r[0], r[2], r[3]);
    }
  return sum / (4 * M_PI);
}

}  // namespace test_support
