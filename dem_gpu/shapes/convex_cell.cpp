// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/shapes/convex_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem_gpu {
namespace {

void add_distinct(std::vector<Vec3>& points, const Vec3& point, Real tolerance) {
  for (const Vec3& known : points)
    if (norm(known - point) <= tolerance) return;
  points.push_back(point);
}

/// The convex polygon of points in a plane: in order about their centre.
std::vector<Vec3> in_order(std::vector<Vec3> points, const Vec3& normal) {
  Vec3 centre;
  for (const Vec3& point : points) centre += point;
  centre = centre / static_cast<Real>(points.size());
  const Vec3 unit = normal / norm(normal), u = any_perpendicular(unit), v = cross(unit, u);
  const auto angle = [&](const Vec3& x) { return std::atan2(dot(v, x - centre), dot(u, x - centre)); };
  std::sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
  return points;
}

}  // namespace

ConvexCell convex_cell(const catalog::ConvexPart& part) {
  ConvexCell cell;
  for (const catalog::ConvexFace& face : part.faces) {
    std::vector<Vec3>& polygon = cell.emplace_back();
    for (const int vertex : face.vertices) {
      const catalog::Point& p = part.vertices[static_cast<std::size_t>(vertex)];
      polygon.push_back({p[0], p[1], p[2]});
    }
  }
  return cell;
}

ConvexCell clipped(const ConvexCell& cell, const HalfSpace& plane, Real tolerance) {
  Real least = std::numeric_limits<Real>::max(), largest = -least;
  for (const std::vector<Vec3>& face : cell)
    for (const Vec3& corner : face) {
      const Real depth = depth_below(plane, corner);
      least = std::min(least, depth);
      largest = std::max(largest, depth);
    }
  if (!(largest > tolerance)) return {};
  if (least >= -tolerance) return cell;
  const auto depth_at = [&](const Vec3& x) {
    const Real depth = depth_below(plane, x);
    return std::abs(depth) <= tolerance ? 0 : depth;
  };
  ConvexCell kept;
  std::vector<Vec3> section;
  bool has_section = false;  // as a face that was there before
  for (const std::vector<Vec3>& face : cell) {
    std::vector<Vec3> piece;
    Vec3 previous = face.back();
    Real previous_depth = depth_at(previous);
    bool lies_in_plane = true;
    for (const Vec3& corner : face) {
      const Real depth = depth_at(corner);
      if ((depth > 0 && previous_depth < 0) || (depth < 0 && previous_depth > 0)) {
        piece.push_back(previous + (previous_depth / (previous_depth - depth)) * (corner - previous));
        add_distinct(section, piece.back(), tolerance);
      }
      if (depth >= 0) piece.push_back(corner);
      if (depth == 0) add_distinct(section, corner, tolerance);
      lies_in_plane &= depth == 0;
      previous = corner;
      previous_depth = depth;
    }
    has_section |= lies_in_plane;
    if (piece.size() >= 3) kept.push_back(std::move(piece));
  }
  if (!has_section && section.size() >= 3) kept.push_back(in_order(std::move(section), plane.normal));
  return kept;
}

Vec3 inner_point(const ConvexCell& cell) {
  Vec3 sum;
  Real count = 0;
  for (const std::vector<Vec3>& face : cell)
    for (const Vec3& corner : face) sum += corner, ++count;
  return sum / count;
}

}  // namespace dem_gpu
