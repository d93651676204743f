// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/periodic/periodic_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "catalog/input_error.h"
#include "dem_gpu/broad_phase/skin.h"
#include "dem_gpu/periodic/wall_extent.h"

namespace dem_gpu {
namespace {

/// How far beyond a face a body may reach, over its bounding radius: before it is taken back in its centre may have
/// drifted half a skin out, a twentieth of a mean diameter (periodic boxes keep the skin they begin with), and one
/// step's travel.
constexpr Real kReachShare = 1.2;
static_assert(kFirstSkin <= Real(0.1));
/// Component of a plane's unit normal along a periodic axis that is rounding.
constexpr Real kNormalRounding = 1e-9;
constexpr std::array<const char*, 3> kAxisName{"x", "y", "z"};

std::string metres(Real length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g m", double(length));
  return text;
}

std::string seconds(Real time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g s", double(time));
  return std::isfinite(time) ? text : "no end of the run";
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
  std::string text() const { return range_text(span.low, span.high); }
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
    const Real x = component(scene.bodies[i].position, side.axis);
    if (x < side.span.low || x >= side.span.high)
      throw catalog::InputError("body " + std::to_string(i) + ": its centre is at " + side.name() + " = " + metres(x) +
                                ", outside the periodic box (" + range_text(side.span.low, side.span.high) +
                                "); move it in by whole widths of " + metres(side.width()));
  }
}

/// A wall that goes past the faces must move alike at both: turn about the periodic axis, if at all.
void check_turning(const Wall& wall, const Side& side) {
  for (const Vec3& turn : {wall.motion.angular_velocity, wall.motion.angular_amplitude}) {
    const Real about_axis = component(turn, side.axis), square = norm_squared(turn);
    if (square - about_axis * about_axis > kNormalRounding * square)
      throw catalog::InputError(
          "wall '" + wall.name + "': it turns about another axis than " + side.name() +
          ", along which the box is periodic, so that it would carry bodies at one face otherwise "
          "than at the other; turn it about " +
          side.name() + ", or make the box not periodic along it");
  }
}

/// When a wall's motion ends to matter: with the run, or as it is removed.
Real last_time(const Scene& scene, const Wall& wall) {
  const Real end = scene.run.end_time > 0 ? scene.run.end_time : std::numeric_limits<Real>::infinity();
  return std::min(end, wall.removed_at.value_or(end));
}

void check_plane(const Wall& wall, const Plane& plane, const Side& side) {
  if (std::abs(component(plane.normal, side.axis)) > kNormalRounding)
    throw catalog::InputError("wall '" + wall.name + "': its normal leans towards " + side.name() +
                              ", along which the box (" + side.text() +
                              ") is periodic, so that bodies would jump into the wall as they cross a face; turn it "
                              "square to " +
                              side.name() + " (tilt gravity instead), or make the box not periodic along it");
  check_turning(wall, side);
}

/// `reach`: of a body beyond a face [m]; `until`: last time of the wall [s].
void check_wall(const Wall& wall, const Side& side, Real reach, Real until) {
  if (const auto* plane = std::get_if<Plane>(&wall.geometry)) return check_plane(wall, *plane, side);
  const std::string place = "wall '" + wall.name + "': ";
  const Extent start = extent_at_start(wall, side.axis), swept = swept_extent(wall, side.axis, until);
  const Extent shift = shift_range(wall.motion, side.axis, until);
  if (start.high <= side.span.low || start.low >= side.span.high)
    throw catalog::InputError(place + "it spans " + range_text(start.low, start.high) + " along " + side.name() +
                              ", outside the periodic box (" + side.text() + "); move it in");
  const Real low = side.span.low, high = side.span.high;
  const auto goes_past = [&](const Extent& e) { return e.low <= low - reach && e.high >= high + reach; };
  const auto keeps_clear = [&](const Extent& e) { return e.low >= low + reach && e.high <= high - reach; };
  // Past both faces wherever it is shifted to: then it may turn about the axis alone, which leaves its ends there.
  if (goes_past({start.low + shift.high, start.high + shift.low})) return check_turning(wall, side);
  if (keeps_clear(swept)) return;
  const bool by_motion = goes_past(start) || keeps_clear(start);
  throw catalog::InputError(
      place + (by_motion ? "by its motion up to " + seconds(until) + " it gets to " : std::string("it spans ")) +
      (by_motion ? range_text(swept.low, swept.high) : range_text(start.low, start.high)) + " along " + side.name() +
      ", and walls do not repeat themselves with the periodic box (" + side.text() +
      "): bodies at a face would meet it on one side alone; let it go past both faces by " + metres(reach) +
      ", or keep it as far away from them inside" +
      (by_motion ? ", all the time: with less motion, a shorter run or an earlier removal" : ""));
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
    for (const Wall& wall : scene.walls) check_wall(wall, side, reach, last_time(scene, wall));
    if (scene.outflow && std::abs(component(scene.outflow->direction, axis)) > kNormalRounding)
      throw catalog::InputError(
          "outflow: its direction leans towards " + side.name() +
          ", along which the box is periodic: what leaves there comes back in; turn it square to " + side.name());
  }
  if (!has_span) throw catalog::InputError("periodic box: it has no span; state x, y or z, or leave it out");
}

}  // namespace dem_gpu
