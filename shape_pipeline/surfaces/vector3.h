// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

using catalog::Point;

inline Point add(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point subtract(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point scaled(const Point& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Point& a) { return std::sqrt(dot(a, a)); }
inline double distance(const Point& a, const Point& b) { return norm(subtract(a, b)); }

/// Unit vector along a, or zero if a is zero.
inline Point normalized(const Point& a) {
  const double length = norm(a);
  return length > 0 ? scaled(a, 1 / length) : Point{};
}

}  // namespace shape_pipeline
