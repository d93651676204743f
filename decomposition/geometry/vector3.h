// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace decomposition {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  Vec3& operator+=(const Vec3& other) { return x += other.x, y += other.y, z += other.z, *this; }
  Vec3& operator-=(const Vec3& other) { return x -= other.x, y -= other.y, z -= other.z, *this; }
};

inline Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
inline Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalized(const Vec3& a) { return (1 / norm(a)) * a; }

inline Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }
inline catalog::Point to_point(const Vec3& p) { return {p.x, p.y, p.z}; }

/// Half-space boundary: inside means signed_distance <= 0.
struct Plane {
  Vec3 normal;  // unit, out of the half-space
  double offset = 0;

  double signed_distance(const Vec3& p) const { return dot(normal, p) - offset; }
  Plane reversed() const { return {-normal, -offset}; }
};

/// Any two unit vectors that make a right-handed frame with `normal`.
inline void plane_axes(const Vec3& normal, Vec3& u, Vec3& v) {
  const double ax = std::abs(normal.x), ay = std::abs(normal.y), az = std::abs(normal.z);
  const Vec3 helper = ax <= ay && ax <= az ? Vec3{1, 0, 0} : (ay <= az ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  u = normalized(cross(helper, normal));
  v = cross(normal, u);
}

struct Box {
  Vec3 low, high;
  double diagonal() const { return norm(high - low); }
  void extend(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool meets(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
           low.z <= other.high.z && other.low.z <= high.z;
  }
};

inline Box bounding_box(const std::vector<Vec3>& points) {
  Box box{points.front(), points.front()};
  for (const Vec3& p : points) box.extend(p);
  return box;
}

inline Box bounding_box(const catalog::TriangleMesh& mesh) {
  Box box{to_vec3(mesh.vertices.front()), to_vec3(mesh.vertices.front())};
  for (const catalog::Point& p : mesh.vertices) box.extend(to_vec3(p));
  return box;
}

}  // namespace decomposition
