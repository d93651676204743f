// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/periodic/periodic_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "catalog/input_error.h"

namespace dem_gpu {
namespace {

/// How far beyond a face a body may reach, over its bounding radius: before it is taken back in its centre may have
/// drifted half a skin out, a twentieth of a mean diameter, and one step's travel.
constexpr Real kReachShare = 1.2;
/// Component of a plane's unit normal along a periodic axis that is rounding.
constexpr Real kNormalRounding = 1e-9;
constexpr std::array<const char*, 3> kAxisName{"x", "y", "z"};

Real along(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

std::string metres(Real length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g m", double(length));
  return text;
}

std::string range_text(Real low, Real high) { return metres(low) + " .. " + metres(high); }

Real bounding_radius(const Scene& scene, const Body& body) {
  const Shape& shape = scene.shapes[body.shape];
  if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry)) return body.scale * sphere->radius;
  Real radius = 0;
  for (const catalog::ConvexPart& part : std::get<PolyhedralShape>(shape.geometry).parts)
    for (const catalog::Point& p : part.vertices) radius = std::max(radius, norm(Vec3{p[0], p[1], p[2]}));
  return body.scale * radius;
}

/// A span along one axis, as messages name it.
struct Side {
  int axis;
  PeriodicSpan span;

  Real width() const { return span.high - span.low; }
  std::string name() const { return kAxisName[static_cast<std::size_t>(axis)]; }
};

/// Where a wall's surface begins and ends along an axis.
struct WallExtent {
  int axis;
  Real low = std::numeric_limits<Real>::max(), high = std::numeric_limits<Real>::lowest();

  void operator()(const Plane&) {}  // endless
  void operator()(const Disc& disc) {
    add_rim(disc.centre, disc.normal, disc.radius);
    add_rim(disc.centre - disc.thickness.value_or(0) * disc.normal, disc.normal, disc.radius);
  }
  void operator()(const Cylinder& cylinder) {
    add_rim(cylinder.base, cylinder.axis, cylinder.radius);
    add_rim(cylinder.base + cylinder.length * cylinder.axis, cylinder.axis, cylinder.radius);
  }
  void operator()(const Cone& cone) {
    add_rim(cone.base, cone.axis, cone.base_radius);
    add_rim(cone.base + cone.length * cone.axis, cone.axis, cone.top_radius);
  }
  void operator()(const Ball& ball) { add(ball.centre, ball.radius); }
  void operator()(const VolumeObject& object) { add_all(object.part.vertices); }
  void operator()(const MeshObject& object) { add_all(object.mesh.vertices); }

 private:
  void add(const Vec3& centre, Real reach) {
    low = std::min(low, along(centre, axis) - reach);
    high = std::max(high, along(centre, axis) + reach);
  }
  void add_rim(const Vec3& centre, const Vec3& normal, Real radius) {
    const Real n = along(normal, axis);
    add(centre, radius * std::sqrt(std::max(1 - n * n, Real(0))));
  }
  template <class Points>
  void add_all(const Points& points) {
    for (const auto& p : points) add({p[0], p[1], p[2]}, 0);
  }
};

void check_span(const Side& side) {
  if (!(std::isfinite(side.span.low) && std::isfinite(side.span.high) && side.span.low < side.span.high))
    throw catalog::InputError("periodic box: along " + side.name() + " it spans " +
                              range_text(side.span.low, side.span.high) + "; low must be less than high");
}

void check_width(const Scene& scene, const Side& side) {
  // Of the two largest bodies each reaches over half the other's: two images of one are 2 (r1 + r2) apart.
  Real largest = 0, second = 0;
  std::size_t body = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Real radius = bounding_radius(scene, scene.bodies[i]);
    if (radius > largest) {
      second = std::exchange(largest, radius);
      body = i;
    } else {
      second = std::max(second, radius);
    }
  }
  const Real least = 2 * (largest + second);
  if (side.width() < least)
    throw catalog::InputError("periodic box: it is " + metres(side.width()) + " wide along " + side.name() +
                              ", so that a body could meet its own image or two of another (the largest, body " +
                              std::to_string(body) + ", has a bounding radius of " + metres(largest) +
                              "); make it at least " + metres(least) + " wide, or the bodies smaller");
}

void check_bodies_inside(const Scene& scene, const Side& side) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Real x = along(scene.bodies[i].position, side.axis);
    if (x < side.span.low || x >= side.span.high)
      throw catalog::InputError("body " + std::to_string(i) + ": its centre is at " + side.name() + " = " + metres(x) +
                                ", outside the periodic box (" + range_text(side.span.low, side.span.high) +
                                "); move it in by whole widths of " + metres(side.width()));
  }
}

/// A wall that goes past the faces must move alike at both: turn about the periodic axis, if at all.
void check_turning(const Wall& wall, const Side& side) {
  for (const Vec3& turn : {wall.motion.angular_velocity, wall.motion.angular_amplitude}) {
    const Real about_axis = along(turn, side.axis), square = norm_squared(turn);
    if (square - about_axis * about_axis > kNormalRounding * square)
      throw catalog::InputError(
          "wall '" + wall.name + "': it turns about another axis than " + side.name() +
          ", along which the box is periodic, so that it would carry bodies at one face otherwise "
          "than at the other; turn it about " +
          side.name() + ", or make the box not periodic along it");
  }
}

void check_wall(const Wall& wall, const Side& side, Real reach) {
  const std::string place = "wall '" + wall.name + "': ", box = range_text(side.span.low, side.span.high);
  if (const auto* plane = std::get_if<Plane>(&wall.geometry)) {
    if (std::abs(along(plane->normal, side.axis)) > kNormalRounding)
      throw catalog::InputError(place + "its normal leans towards " + side.name() + ", along which the box (" + box +
                                ") is periodic, so that bodies would jump into the wall as they cross a face; turn it "
                                "square to " +
                                side.name() + " (tilt gravity instead), or make the box not periodic along it");
    check_turning(wall, side);
    return;
  }
  WallExtent extent{side.axis};
  std::visit([&](const auto& geometry) { extent(geometry); }, wall.geometry);
  const std::string where = "it spans " + range_text(extent.low, extent.high) + " along " + side.name();
  if (extent.high <= side.span.low || extent.low >= side.span.high)
    throw catalog::InputError(place + where + ", outside the periodic box (" + box + "); move it in");
  const bool goes_past = extent.low <= side.span.low - reach && extent.high >= side.span.high + reach;
  const bool keeps_clear = extent.low >= side.span.low + reach && extent.high <= side.span.high - reach;
  if (!goes_past && !keeps_clear)
    throw catalog::InputError(place + where + ", and walls do not repeat themselves with the periodic box (" + box +
                              "): bodies at a face would meet it on one side alone; let it go past both faces by " +
                              metres(reach) + ", or keep it as far away from them inside");
  if (goes_past) check_turning(wall, side);
}

}  // namespace

void check_periodic(const Scene& scene) {
  if (!scene.periodic) return;
  Real reach = 0;
  for (const Body& body : scene.bodies)
    if (!body.is_fixed) reach = std::max(reach, kReachShare * bounding_radius(scene, body));
  bool has_span = false;
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<PeriodicSpan>& span = scene.periodic->span[static_cast<std::size_t>(axis)];
    if (!span) continue;
    has_span = true;
    const Side side{axis, *span};
    check_span(side);
    check_width(scene, side);
    check_bodies_inside(scene, side);
    for (const Wall& wall : scene.walls) check_wall(wall, side, reach);
    if (scene.outflow && std::abs(along(scene.outflow->direction, axis)) > kNormalRounding)
      throw catalog::InputError(
          "outflow: its direction leans towards " + side.name() +
          ", along which the box is periodic: what leaves there comes back in; turn it square to " + side.name());
  }
  if (!has_span) throw catalog::InputError("periodic box: it has no span; state x, y or z, or leave it out");
}

}  // namespace dem_gpu
