// SPDX-License-Identifier: Apache-2.0
#include "workflows/initial_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "catalog/convex_part.h"

namespace workflows {
namespace {

using dem_gpu::Vec3;

constexpr double kClear = -std::numeric_limits<double>::infinity();

Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }

struct AxisPosition {
  double along, off_axis;  // [m]
};

AxisPosition axis_position(const Vec3& point, const Vec3& base, const Vec3& axis) {
  const Vec3 from_base = point - base;
  const double along = dot(from_base, axis);
  return {along, norm(from_base - along * axis)};
}

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = unit_or(cross(b - a, c - a), {0, 0, 1});
  const Vec3* corner[] = {&a, &b, &c};
  bool is_over_face = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3 &from = *corner[i], edge = *corner[(i + 1) % 3] - from;
    is_over_face = is_over_face && dot(cross(edge, p - from), normal) >= 0;
    const double t = std::clamp(dot(p - from, edge) / norm_squared(edge), 0.0, 1.0);
    nearest = std::min(nearest, norm(p - from - t * edge));
  }
  return is_over_face ? std::abs(dot(p - a, normal)) : nearest;
}

/// Signed: negative inside.
double distance_to(const catalog::ConvexPart& part, const Vec3& point) {
  double above = kClear;
  for (const catalog::ConvexFace& face : part.faces)
    above = std::max(above, dot(to_vec3(face.plane.normal), point) - face.plane.offset);
  if (above <= 0) return above;
  const catalog::TriangleMesh surface = triangulated(part);
  double nearest = std::numeric_limits<double>::infinity();
  for (const catalog::Triangle& t : surface.faces)
    nearest = std::min(nearest, distance_to_triangle(point, to_vec3(surface.vertices[t[0]]),
                                                     to_vec3(surface.vertices[t[1]]), to_vec3(surface.vertices[t[2]])));
  return nearest;
}

struct ReachInto {
  Vec3 centre;
  double radius;
  const std::optional<dem_gpu::MeshProbe>& mesh;

  double operator()(const dem_gpu::Plane& plane) const { return radius - dot(centre - plane.point, plane.normal); }

  double operator()(const dem_gpu::Disc& disc) const {
    const AxisPosition at = axis_position(centre, disc.centre, disc.normal);
    const double beside = std::max(0.0, at.off_axis - disc.radius);
    if (disc.thickness) {
      const double over = std::max(at.along, -*disc.thickness - at.along);
      return radius - std::hypot(std::max(0.0, over), beside);
    }
    // From either side: a body behind the plate is beyond it, not in it.
    return radius - std::hypot(at.along, beside);
  }

  double operator()(const dem_gpu::Cylinder& cylinder) const {
    const AxisPosition at = axis_position(centre, cylinder.base, cylinder.axis);
    if (at.along < 0 || at.along > cylinder.length) return kClear;
    return reach_beyond(at.off_axis - cylinder.radius, cylinder.solid);
  }

  double operator()(const dem_gpu::Cone& cone) const {
    const AxisPosition at = axis_position(centre, cone.base, cone.axis);
    if (at.along < 0 || at.along > cone.length) return kClear;
    const double slope = (cone.top_radius - cone.base_radius) / cone.length;
    return reach_beyond((at.off_axis - cone.base_radius - slope * at.along) / std::sqrt(1 + slope * slope), cone.solid);
  }

  double operator()(const dem_gpu::Ball& ball) const {
    return reach_beyond(norm(centre - ball.centre) - ball.radius, ball.solid);
  }

  double operator()(const dem_gpu::VolumeObject& object) const { return radius - distance_to(object.part, centre); }

  double operator()(const dem_gpu::MeshObject&) const { return radius - mesh->distance(centre); }

  /// `outside`: of the centre beyond a curved surface, from its axis [m].
  double reach_beyond(double outside, dem_gpu::SolidSide solid) const {
    return radius + (solid == dem_gpu::SolidSide::around ? outside : -outside);
  }
};

}  // namespace

WallReach::WallReach(const dem_gpu::Wall& wall) : wall_(wall) {
  if (const auto* mesh = std::get_if<dem_gpu::MeshObject>(&wall.geometry)) mesh_.emplace(*mesh);
}

double WallReach::reach_of(const Vec3& centre, double radius) const {
  return std::visit(ReachInto{centre, radius, mesh_}, wall_.geometry);
}

std::string overlapping_balls(const std::vector<InitialBall>& balls, const std::vector<std::string>& group_names) {
  // Sweep along x: only balls whose extents overlap there are compared.
  std::vector<std::size_t> order(balls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto start = [&](std::size_t i) { return balls[i].centre.x - balls[i].radius; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return start(a) < start(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const InitialBall& a = balls[order[i]];
    for (std::size_t j = i + 1; j < order.size() && start(order[j]) < a.centre.x + a.radius; ++j) {
      const InitialBall& b = balls[order[j]];
      if (a.group == b.group || norm(a.centre - b.centre) >= a.radius + b.radius) continue;
      return "bodies of " + group_names[static_cast<std::size_t>(std::min(a.group, b.group))] + " and " +
             group_names[static_cast<std::size_t>(std::max(a.group, b.group))] +
             " would start inside one another; move their regions apart, or give both the same region to mix them";
    }
  }
  return {};
}

}  // namespace workflows
