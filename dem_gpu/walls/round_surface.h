// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "dem_gpu/narrow_phase/face_polygon.h"
#include "dem_gpu/walls/wall_surface.h"

namespace dem_gpu {

/// Surface of a ball, or of a cylinder or cone that has no ends, in axes about a body's centre. Its gap at x is the
/// distance from centre or axis less the surface's radius there: a convex function of x.
struct RoundSurface {
  Vec3 point;             // centre, or on the axis at the base [m]
  Vec3 axis;              // unit; zero for a ball
  Real radius = 0;        // at the base [m]
  Real slope = 0;         // growth of the radius along the axis
  Real depth_factor = 1;  // depth over gap; negative with the solid within

  TALUS_HD RoundSurface(const WallRecord& wall, const Vec3& body_centre)
      : point(wall.point - body_centre), radius(wall.base_radius) {
    if (wall.kind != WallKind::sphere) {
      axis = wall.direction;
      slope = (wall.top_radius - wall.base_radius) / wall.length;
    }
    depth_factor = (wall.solid_within ? -1 : 1) / std::sqrt(1 + slope * slope);
  }

  TALUS_HD Real depth_of(Real gap) const { return depth_factor * gap; }
  /// From the wall to the bodies, where `radial` is the position off the axis; none on the axis.
  TALUS_HD Vec3 normal_at(const Vec3& radial) const {
    return (-depth_factor) * (unit_or(radial, Vec3{}) - slope * axis);
  }
};

/// A round surface seen along the line from + t step.
struct RoundLine {
  Vec3 radial, radial_step;      // position off the axis, or from the centre [m]
  Real surface = 0, growth = 0;  // radius of the surface there [m]
  Real a = 0, b = 0, c = 0;      // radial^2 - surface^2 = a t^2 + 2 b t + c: has the sign of the gap [m2]

  TALUS_HD RoundLine(const RoundSurface& round, const Vec3& from, const Vec3& step) {
    const Vec3 offset = from - round.point;
    const Real along = dot(offset, round.axis), along_step = dot(step, round.axis);
    radial = offset - along * round.axis;
    radial_step = step - along_step * round.axis;
    surface = round.radius + round.slope * along;
    growth = round.slope * along_step;
    a = norm_squared(radial_step) - growth * growth;
    b = dot(radial, radial_step) - surface * growth;
    c = norm_squared(radial) - surface * surface;
  }

  TALUS_HD Vec3 radial_at(Real t) const { return radial + t * radial_step; }
  TALUS_HD Real gap_at(Real t) const { return norm(radial_at(t)) - (surface + t * growth); }

  /// Where the line, negative gap at t = 0, leaves it; `none` if it never does.
  TALUS_HD Real exit(Real none) const {
    const Real root = std::sqrt(std::max(b * b - a * c, Real(0)));
    if (b > 0) return -c / (b + root);
    return a > 0 ? (root - b) / a : none;
  }

  /// Where in [0, 1] the gap is least.
  TALUS_HD Real least_gap_at() const {
    const Real square = norm_squared(radial_step);
    if (!(a > 0)) return growth > 0 ? 1 : 0;
    Real t = -dot(radial, radial_step) / square;
    if (growth != 0) t += growth * std::sqrt(norm_squared(radial_at(t)) / (square * a));
    return std::min(std::max(t, Real(0)), Real(1));
  }
};

/// The piece of [0, 1] with negative gap; empty if low == high.
struct NegativeGap {
  Real low = 0, high = 0;

  /// `reversed`: the same line from its end.
  TALUS_HD NegativeGap(const RoundLine& line, const RoundLine& reversed) {
    const bool starts = line.c < 0, ends = reversed.c < 0;
    if (starts || ends) {
      low = starts ? 0 : std::max(1 - reversed.exit(1), Real(0));
      high = ends ? 1 : std::min(line.exit(1), Real(1));
      return;
    }
    const Real square = line.b * line.b - line.a * line.c;
    if (!(line.a > 0 && line.b < 0 && -line.b < line.a && square > 0)) return;
    const Real root = std::sqrt(square);
    low = std::max((-line.b - root) / line.a, Real(0));
    high = std::min((-line.b + root) / line.a, Real(1));
  }
};

/// A point of a face and the gap there.
struct GapPoint {
  Vec3 point;
  Real gap = 0;      // [m]
  Real surface = 0;  // radius of the surface there [m]
};

/// Where the gap is least on a face: on an edge, or where the axis pierces the face, or at the foot of the ball's
/// centre (from the point on the axis the gap is linear along each ray, so a least one elsewhere lies on an edge).
TALUS_HD inline GapPoint least_gap(const RoundSurface& round, const FacePolygon& face, const Vec3& normal) {
  GapPoint least;
  const bool is_ball = round.axis == Vec3{};
  const Vec3 direction = is_ball ? normal : round.axis;
  const Real along = dot(normal, direction);
  const Vec3 middle =
      along != 0 ? round.point + (dot(normal, Vec3(face.corner[0]) - round.point) / along) * direction : Vec3{};
  bool is_pierced = along != 0;
  Vec3 from = face.corner[face.count - 1];
  for (int i = 0; i < face.count; ++i) {
    const Vec3 to = face.corner[i], step = to - from;
    const RoundLine edge(round, from, step);
    const Real t = edge.least_gap_at(), gap = edge.gap_at(t);
    if (i == 0 || gap < least.gap) least = {from + t * step, gap, edge.surface + t * edge.growth};
    if (is_pierced) is_pierced = dot(cross(step, middle - from), normal) > 0;
    from = to;
  }
  if (!is_pierced) return least;
  const RoundLine inner(round, middle, {});
  return inner.gap_at(0) < least.gap ? GapPoint{middle, inner.gap_at(0), inner.surface} : least;
}

}  // namespace dem_gpu
