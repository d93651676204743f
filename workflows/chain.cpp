// SPDX-License-Identifier: Apache-2.0
#include "workflows/chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "catalog/input_error.h"
#include "dem_gpu/overlap_probe.h"

namespace workflows {
namespace {

using dem_gpu::Body;
using dem_gpu::Quaternion;
using dem_gpu::Shape;
using dem_gpu::Vec3;

const std::vector<catalog::ConvexPart>& parts_of(const Shape& shape) {
  return std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts;
}

Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }

/// A ray may lie in a cut between two parts: planes that it makes a smaller angle with than this rounding [rad] do not
/// bound it.
constexpr double kParallel = 1e-9;

/// Where the ray from the centre along `direction` enters the part; infinite if it misses it [m].
double entry(const catalog::ConvexPart& part, const Vec3& direction) {
  double from = 0, to = std::numeric_limits<double>::infinity();
  bool misses = false;
  for (const catalog::ConvexFace& face : part.faces) {
    const double slope = dot(to_vec3(face.plane.normal), direction), offset = face.plane.offset;
    if (std::abs(slope) < kParallel)
      misses |= offset < 0 && face.kind == catalog::FaceKind::outer;
    else if (slope < 0)
      from = std::max(from, offset / slope);
    else
      to = std::min(to, offset / slope);
  }
  return !misses && from <= to ? from : std::numeric_limits<double>::infinity();
}

double inner_distance(const Shape& shape, const Vec3& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const catalog::ConvexPart& part : parts_of(shape)) nearest = std::min(nearest, entry(part, direction));
  return nearest;
}

double outer_distance(const Shape& shape, const Vec3& direction) {
  double farthest = 0;
  for (const catalog::ConvexPart& part : parts_of(shape))
    for (const catalog::Point& vertex : part.vertices) farthest = std::max(farthest, dot(to_vec3(vertex), direction));
  return farthest;
}

double extent(const Shape& shape, const Vec3& axis) {
  return outer_distance(shape, axis) + outer_distance(shape, -axis);
}

/// Turn that takes the unit vectors a and b (at right angles) to a_to and b_to (at right angles).
Quaternion turn_of(const Vec3& a, const Vec3& b, const Vec3& a_to, const Vec3& b_to) {
  const Vec3 axis = cross(a, a_to);
  Quaternion first;
  if (norm(axis) > 1e-12)
    first = dem_gpu::axis_angle(axis / norm(axis), std::atan2(norm(axis), dot(a, a_to)));
  else if (dot(a, a_to) < 0)
    first = dem_gpu::axis_angle(b, std::numbers::pi);
  const Vec3 b_now = rotate(first, b);
  return dem_gpu::axis_angle(a_to, std::atan2(dot(cross(b_now, b_to), a_to), dot(b_now, b_to))) * first;
}

std::string millimetres(double length) { return std::to_string(1e3 * length) + " mm"; }

/// Thickness of the wire where links meet [m].
double wire_thickness(const LinkHole& hole) {
  return std::min(hole.outer_ahead - hole.inner_ahead, hole.outer_behind - hole.inner_behind);
}

/// Pitch below which every second link, lying the same way, meets [m].
double every_second_meets(const LinkHole& hole) { return (hole.outer_ahead + hole.outer_behind) / 2; }

[[noreturn]] void refuse_hole(const LinkHole& hole, const std::string& place) {
  throw catalog::InputError(place + ": the hole, " + millimetres(hole.inner_ahead + hole.inner_behind) +
                            " long, is too small for the two wires that share it; take a link with a wider hole or a "
                            "thinner wire, or a smaller gap");
}

/// Largest distance of two neighbouring links' centres at which they do not overlap [m]: by bisection, since the wire's
/// curve narrows the hole by an amount that depends on the shape.
double taut_pitch(const Shape& link, const LinkHole& hole, const std::string& place) {
  const dem_gpu::OverlapProbe probe(link, link, dem_gpu::DepthPotential{1});
  const Vec3 across = cross(hole.length, hole.normal);
  const Quaternion quarter = turn_of(hole.length, hole.normal, hole.length, across);
  const auto overlaps_at = [&](double pitch) {
    return probe.overlap({{}, {pitch * hole.length, quarter, 1}}).volume > 0;
  };
  double apart = every_second_meets(hole), touching = hole.inner_ahead + hole.inner_behind;
  if (apart >= touching || overlaps_at(apart)) refuse_hole(hole, place);
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (apart + touching) / 2;
    (overlaps_at(middle) ? touching : apart) = middle;
  }
  return apart;
}

void refuse_overlaps(const Shape& link, const std::vector<Body>& bodies, bool is_closed, const std::string& place) {
  const dem_gpu::OverlapProbe probe(link, link, dem_gpu::DepthPotential{1});
  const std::size_t n = bodies.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t apart = 1; apart <= 2; ++apart) {
      const std::size_t j = (i + apart) % n;
      if (j == i || (!is_closed && i + apart >= n)) continue;
      const auto pose = [&](std::size_t k) { return dem_gpu::BodyPose{bodies[k].position, bodies[k].orientation, 1}; };
      if (probe.overlap({pose(i), pose(j)}).volume > 0)
        throw catalog::InputError(place + ": links " + std::to_string(i) + " and " + std::to_string(j) +
                                  " would overlap; take a link with a wider hole or a thinner wire" +
                                  (is_closed ? ", more links on the circle, or a larger gap" : ""));
    }
}

}  // namespace

LinkHole link_hole(const Shape& shape, const std::string& place) {
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (std::holds_alternative<dem_gpu::PolyhedralShape>(shape.geometry))
    for (int n = 0; n < 3; ++n) {
      if (std::isfinite(inner_distance(shape, axes[n])) || std::isfinite(inner_distance(shape, -axes[n]))) continue;
      const Vec3 &u = axes[(n + 1) % 3], &v = axes[(n + 2) % 3];
      LinkHole hole;
      hole.normal = axes[n];
      hole.length = extent(shape, u) >= extent(shape, v) ? u : v;
      hole.inner_ahead = inner_distance(shape, hole.length);
      hole.inner_behind = inner_distance(shape, -hole.length);
      hole.outer_ahead = outer_distance(shape, hole.length);
      hole.outer_behind = outer_distance(shape, -hole.length);
      if (std::isfinite(hole.inner_ahead) && std::isfinite(hole.inner_behind)) return hole;
    }
  throw catalog::InputError(place + ": shape '" + shape.name +
                            "' has no hole along a principal axis through its centre; a link must be a closed ring");
}

std::vector<Body> chain_bodies(const Shape& link, const ChainLayout& layout, const std::string& place) {
  const LinkHole hole = link_hole(link, place);
  const double pitch = taut_pitch(link, hole, place) - layout.gap * wire_thickness(hole);
  if (pitch <= every_second_meets(hole)) refuse_hole(hole, place);
  if (layout.is_closed && (layout.links < 4 || layout.links % 2 != 0))
    throw catalog::InputError(place + ": a closed chain needs an even number of links, 4 or more; it has " +
                              std::to_string(layout.links));
  const Vec3 side = dem_gpu::any_perpendicular(layout.direction), other = cross(layout.direction, side);
  const double step = 2 * std::numbers::pi / layout.links, radius = pitch / (2 * std::sin(step / 2));
  std::vector<Body> bodies;
  for (int i = 0; i < layout.links; ++i) {
    Body body;
    // Along the chain, and the two directions across it that the links' planes alternate between.
    Vec3 along = layout.direction, across = side, upright = other;
    body.position = layout.start + i * pitch * layout.direction;
    if (layout.is_closed) {
      const Vec3 outward = std::cos(i * step) * side + std::sin(i * step) * other;
      along = cross(layout.direction, outward);
      across = outward;
      upright = layout.direction;
      body.position = layout.start + radius * (outward - side);
    }
    body.orientation = turn_of(hole.length, hole.normal, along, i % 2 == 0 ? across : upright);
    body.is_fixed = layout.holds_first && i == 0;
    bodies.push_back(body);
  }
  refuse_overlaps(link, bodies, layout.is_closed, place);
  return bodies;
}

}  // namespace workflows
