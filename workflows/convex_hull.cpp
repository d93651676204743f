// SPDX-License-Identifier: Apache-2.0
#include "workflows/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "catalog/input_error.h"

namespace workflows {
namespace {

using catalog::Point;

// Points this close to a plane lie in it / size of the point set: far above rounding, far below a real edge.
constexpr double kPlaneTolerance = 1e-9;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point scaled(const Point& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

double extent(const std::vector<Point>& points) {
  double largest = 0;
  for (const Point& point : points)
    for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(point[i] - points.front()[i]));
  return largest;
}

/// Corners of the polygon that the points in a plane span, counter-clockwise about its normal (gift wrapping).
std::vector<int> polygon(const std::vector<Point>& points, const std::vector<int>& in_plane, const Point& normal,
                         double tolerance) {
  const auto further = [&](int a, int b, int from) {
    return dot(minus(points[a], points[from]), minus(points[a], points[from])) >
           dot(minus(points[b], points[from]), minus(points[b], points[from]));
  };
  // The point furthest from the first is surely a corner.
  int start = in_plane.front();
  for (const int candidate : in_plane)
    if (further(candidate, start, in_plane.front())) start = candidate;
  std::vector<int> corners;
  int current = start;
  do {
    corners.push_back(current);
    int next = in_plane.front() == current ? in_plane.back() : in_plane.front();
    for (const int candidate : in_plane) {
      if (candidate == current || candidate == next) continue;
      const Point edge = minus(points[next], points[current]);
      const double right =
          -dot(cross(edge, minus(points[candidate], points[current])), normal) / std::sqrt(dot(edge, edge));
      if (right > tolerance || (right > -tolerance && further(candidate, next, current))) next = candidate;
    }
    current = next;
  } while (current != start && corners.size() <= in_plane.size());
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

catalog::ConvexPart convex_hull(const std::vector<Point>& points) {
  const int count = static_cast<int>(points.size());
  if (count < 4) throw catalog::InputError("a convex body needs 4 points or more");
  const double size = extent(points), tolerance = kPlaneTolerance * size;
  catalog::ConvexPart part;
  part.vertices = points;
  std::vector<char> is_corner(points.size(), 0);
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b)
      for (int c = b + 1; c < count; ++c) {
        Point normal = cross(minus(points[b], points[a]), minus(points[c], points[a]));
        const double length = std::sqrt(dot(normal, normal));
        if (!(length > tolerance * size)) continue;
        normal = scaled(normal, 1 / length);
        std::vector<int> in_plane;
        bool has_above = false, has_below = false;
        for (int p = 0; p < count; ++p) {
          const double height = dot(minus(points[p], points[a]), normal);
          if (std::abs(height) <= tolerance)
            in_plane.push_back(p);
          else
            (height > 0 ? has_above : has_below) = true;
        }
        if (has_above && has_below) continue;
        if (!has_above && !has_below) throw catalog::InputError("the points lie in one plane");
        // Each plane once: by its first three points that are not in line.
        if (std::any_of(part.faces.begin(), part.faces.end(), [&](const catalog::ConvexFace& face) {
              return std::all_of(in_plane.begin(), in_plane.end(), [&](int p) {
                return std::abs(dot(face.plane.normal, points[p]) - face.plane.offset) <= 2 * tolerance;
              });
            }))
          continue;
        if (has_above) normal = scaled(normal, -1);
        catalog::ConvexFace face;
        face.vertices = polygon(points, in_plane, normal, tolerance);
        face.plane = {normal, dot(normal, points[a])};
        for (const int corner : face.vertices) is_corner[corner] = 1;
        part.faces.push_back(face);
      }
  if (part.faces.empty()) throw catalog::InputError("the points lie in one line or plane");
  for (int p = 0; p < count; ++p)
    if (!is_corner[p])
      throw catalog::InputError("point " + std::to_string(p) + " (counting from 0) is no corner of the convex body");
  return part;
}

}  // namespace workflows
