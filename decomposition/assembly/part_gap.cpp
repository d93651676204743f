// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/assembly/part_gap.h"

#include <limits>
#include <vector>

#include "decomposition/geometry/vector3.h"

namespace decomposition {
namespace {

constexpr double kGap = 1e-9;       // of the diagonal of both: above the rounding of heights along an axis
constexpr double kParallel = 1e-6;  // sine: edges nearer to parallel give no axis

struct Corners {
  std::vector<Vec3> points;
  std::vector<Vec3> edges, normals;  // unit

  /// Seen from `origin`, so that bodies far away keep their digits.
  Corners(const catalog::ConvexPart& part, const Vec3& origin) {
    for (const catalog::Point& p : part.vertices) points.push_back(to_vec3(p) - origin);
    for (const catalog::ConvexFace& face : part.faces) {
      normals.push_back(to_vec3(face.plane.normal));
      for (std::size_t k = 0; k < face.vertices.size(); ++k) {
        const int v = face.vertices[k], next = face.vertices[(k + 1) % face.vertices.size()];
        if (v > next) continue;  // the face beyond has it the other way round
        edges.push_back(normalized(points[static_cast<std::size_t>(next)] - points[static_cast<std::size_t>(v)]));
      }
    }
  }
};

/// Width of the gap between two sets of points along a unit axis; negative if there is none.
double gap_along(const Vec3& axis, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
  };
  const auto range = [&](const std::vector<Vec3>& points) {
    Range result;
    for (const Vec3& p : points) {
      result.low = std::min(result.low, dot(axis, p));
      result.high = std::max(result.high, dot(axis, p));
    }
    return result;
  };
  const Range first = range(a), second = range(b);
  return std::max(first.low - second.high, second.low - first.high);
}

Vec3 middle(const Box& box) { return 0.5 * (box.low + box.high); }

}  // namespace

bool have_gap(const catalog::ConvexPart& a, const catalog::ConvexPart& b) {
  const Vec3 origin = to_vec3(a.vertices.front());
  const Corners first(a, origin), second(b, origin);
  const Box box = bounding_box(first.points), other = bounding_box(second.points);
  if (!box.meets(other)) return true;
  const double smallest = kGap * (box.diagonal() + other.diagonal());
  const auto parts_them = [&](const Vec3& axis) { return gap_along(axis, first.points, second.points) > smallest; };
  if (const Vec3 between = middle(other) - middle(box); norm(between) > 0 && parts_them(normalized(between)))
    return true;
  for (const std::vector<Vec3>* normals : {&first.normals, &second.normals})
    for (const Vec3& normal : *normals)
      if (parts_them(normal)) return true;
  for (const Vec3& u : first.edges)
    for (const Vec3& v : second.edges)
      if (const Vec3 axis = cross(u, v); norm(axis) > kParallel && parts_them(normalized(axis))) return true;
  return false;
}

}  // namespace decomposition
