// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "dem_gpu/core/scratch_array.h"
#include "dem_gpu/walls/round_surface.h"
#include "dem_gpu/walls/wall_integrals.h"

namespace dem_gpu {

/// Gauss-Legendre rule on [0, 1], exact to degree 7.
struct GaussRule {
  static constexpr int kPoints = 4;
  TALUS_HD static Real point(int i) {
    constexpr Real kPoint[kPoints] = {Real(0.06943184420297371), Real(0.33000947820757187), Real(0.66999052179242813),
                                      Real(0.93056815579702629)};
    return kPoint[i];
  }
  TALUS_HD static Real weight(int i) {
    constexpr Real kWeight[kPoints] = {Real(0.17392742256872693), Real(0.32607257743127307), Real(0.32607257743127307),
                                       Real(0.17392742256872693)};
    return kWeight[i];
  }
};

/// Integrals of the depth below a ball's, cylinder's or cone's surface over one face. The face is seen from its point
/// of least gap: rays from there to the edges cross the surface at most once, so the part of a ray in the solid is one
/// interval, on which the depth is smooth. Gauss's rule along the rays and along the edges then leaves errors of the
/// eighth power of (edge / radius of the wall), and the force is the gradient of the depth's integral over the overlap
/// as nearly as that; pieces with a depth taken as linear would not make a closed path's work vanish.
template <class Integrals>
class RoundFace {
 public:
  TALUS_HD RoundFace(const RoundSurface& round, const FacePolygon& face, const Vec3& normal, bool is_outer)
      : round_(round),
        face_(face),
        normal_(normal),
        is_outer_(is_outer),
        is_within_(round.depth_factor < 0),
        least_(least_gap(round, face, normal)) {}

  TALUS_HD void add_to(Integrals& integrals) const {
    if (is_within_ && !has_gap()) return;
    if (is_within_ && is_outer_) integrals.reach(round_.depth_of(least_.gap));
    Vec3 start = face_.corner[face_.count - 1];
    for (int i = 0; i < face_.count; ++i) {
      const Vec3 end = face_.corner[i];
      add_edge(start, end, integrals);
      start = end;
    }
  }

 private:
  /// The gap is negative somewhere on the face.
  TALUS_HD bool has_gap() const { return least_.gap < 0; }

  /// A piece of an edge: start + t step for t in [low, high]. `area`: twice that of the triangle from the point of
  /// least gap to the whole edge.
  struct Stretch {
    Vec3 start, step;
    Real area, low, high;
    bool is_cut;  // the rays to it leave the surface on their way
  };

  TALUS_HD void add_edge(const Vec3& start, const Vec3& end, Integrals& integrals) const {
    const Vec3 step = end - start;
    const RoundLine line(round_, start, step);
    if (!is_within_ && is_outer_) integrals.reach(round_.depth_of(line.gap_at(0)));
    const Real area = dot(cross(start - least_.point, step), normal_);
    if (!(area > 0)) return;
    if (!has_gap()) {
      add_stretch({start, step, area, 0, 1, false}, integrals);
      return;
    }
    const NegativeGap inside(line, RoundLine(round_, end, -step));
    if (inside.low == inside.high) {
      add_stretch({start, step, area, 0, 1, true}, integrals);
      return;
    }
    if (is_within_) add_stretch({start, step, area, inside.low, inside.high, false}, integrals);
    if (inside.low > 0) add_stretch({start, step, area, 0, inside.low, true}, integrals);
    if (inside.high < 1) add_stretch({start, step, area, inside.high, 1, true}, integrals);
  }

  /// In panels no longer than the surface's radius.
  TALUS_HD void add_stretch(const Stretch& stretch, Integrals& integrals) const {
    constexpr int kMostPanels = 12;
    const Real span = stretch.high - stretch.low, length = span * norm(stretch.step);
    const int by_wall =
        1 + static_cast<int>(std::min(length / std::max(least_.surface, length / kMostPanels), Real(kMostPanels - 1)));
    const ExitBranch branch = stretch.is_cut ? exit_branch(stretch) : ExitBranch{};
    if (!stretch.is_cut || branch.is_clear(stretch.low, stretch.high)) {
      for (int k = 0; k < by_wall; ++k)
        add_panel(stretch, stretch.low + span * k / by_wall, stretch.low + span * (k + 1) / by_wall, integrals);
      return;
    }
    const Real from = branch.scaled(stretch.low), range = branch.scaled(stretch.high) - from;
    const int count = std::max(by_wall, 1 + static_cast<int>(std::min(2 * range, Real(kMostPanels - 1))));
    Real before = stretch.low;
    for (int k = 1; k <= count; ++k) {
      const Real next = k == count ? stretch.high : branch.place(from + range * k / count);
      add_panel(stretch, before, next, integrals);
      before = next;
    }
  }

  /// Where the rays' exit, a function of the place along an edge, branches: at foot +- i height. Panels of equal
  /// asinh((place - foot) / height) are as long as that is far, which keeps the rule's accuracy.
  struct ExitBranch {
    Real foot = 0, height = 0;  // in edge lengths

    TALUS_HD bool is_clear(Real low, Real high) const {
      const Real beside = std::max(std::max(low - foot, foot - high), Real(0));
      return 4 * (high - low) * (high - low) <= height * height + beside * beside;
    }
    TALUS_HD Real scaled(Real place) const { return std::asinh((place - foot) / height); }
    TALUS_HD Real place(Real scaled) const { return foot + height * std::sinh(scaled); }
  };
  TALUS_HD ExitBranch exit_branch(const Stretch& stretch) const {
    constexpr Real kLeastHeight = Real(1e-6);  // nearer than this to an edge the integrals hold nothing
    const RoundLine ray(round_, least_.point, stretch.start - least_.point);
    const RoundLine along(round_, least_.point, stretch.step);
    const Real mixed = dot(ray.radial_step, along.radial_step) - ray.growth * along.growth;
    // Discriminant of the exit from the surface: p t^2 + 2 q t + r.
    const Real p = along.b * along.b - along.c * along.a, q = ray.b * along.b - ray.c * mixed;
    const Real r = ray.b * ray.b - ray.c * ray.a;
    if (!(p > 0)) return {Real(0.5), Real(0.5)};
    return {-q / p, std::max(std::sqrt(std::max(p * r - q * q, Real(0))) / p, kLeastHeight)};
  }

  TALUS_HD void add_panel(const Stretch& stretch, Real low, Real high, Integrals& integrals) const {
    for (int i = 0; i < GaussRule::kPoints; ++i) {
      const Vec3 x = stretch.start + (low + (high - low) * GaussRule::point(i)) * stretch.step - least_.point;
      add_ray(x, (high - low) * GaussRule::weight(i) * stretch.area, stretch.is_cut, integrals);
    }
  }

  /// The ray from the point of least gap by x, which stands for the area `weight` t dt at t x.
  TALUS_HD void add_ray(const Vec3& x, Real weight, bool is_cut, Integrals& integrals) const {
    const RoundLine ray(round_, least_.point, x);
    Real low = 0, high = 1;
    if (is_cut) (is_within_ ? high : low) = std::min(std::max(ray.exit(1), Real(0)), Real(1));
    Real depth = 0, first = 0, second = 0, area = 0;  // integrals of psi, t psi, t^2 psi and psi'
    for (int i = 0; i < GaussRule::kPoints; ++i) {
      const Real t = low + (high - low) * GaussRule::point(i);
      const Real share = weight * (high - low) * GaussRule::weight(i) * t;
      const Real below = std::max(round_.depth_of(ray.gap_at(t)), Real(0));
      const Real psi = share * integrals.profile.value(below);
      depth += psi;
      first += psi * t;
      second += psi * t * t;
      area += share * integrals.profile.slope(below);
    }
    if (!(depth > 0)) return;
    const Real square =
        depth * norm_squared(least_.point) + 2 * first * dot(least_.point, x) + second * norm_squared(x);
    const WallPiece piece{depth, depth * least_.point + first * x, area, square};
    integrals.add_piece(piece, normal_, round_.normal_at(ray.radial_at(first / depth)), is_outer_);
  }

  const RoundSurface& round_;
  const FacePolygon& face_;
  const Vec3 normal_;
  const bool is_outer_;
  const bool is_within_;  // the wall's solid is within its surface
  const GapPoint least_;
};

/// Face f of a part, in the world's axes about the body's centre.
TALUS_HD inline void placed_face(const PartView& part, const Pose& pose, int f, FacePolygon& face) {
  const FaceCorners corners = part.faces[f];
  face.count = corners.count;
  face.is_truncated = false;
  for (int c = 0; c < corners.count; ++c)
    face.corner[c] = rounded(pose.scale * (pose.rotation * part.vertices[part.corners[corners.first + c]]));
}

/// Adds one convex part of a body at `pose` to the integrals of a ball, cylinder or cone. False if a polygon was
/// truncated.
template <class Integrals>
TALUS_HD bool integrate_part_on_round_wall(const PartView& part, const Pose& pose, const WallRecord& wall,
                                           Integrals& integrals) {
  const Vec3 centre = pose.scale * (pose.rotation * part.range.centre) + pose.position;
  const Real radius = pose.scale * part.range.radius;
  if (wall_field(wall, centre).depth + radius <= 0) return true;
  const RoundSurface round(wall, pose.position);
  const Vec3 top = round.point + wall.length * round.axis;
  const LocalHalfSpace ends[2] = {rounded(HalfSpace{-round.axis, -dot(round.axis, round.point)}),
                                  rounded(HalfSpace{round.axis, dot(round.axis, top)})};
  const Real largest = std::max(wall.base_radius, wall.top_radius);
  FacePolygon buffer[2];
  for (int f = 0; f < part.range.face_count; ++f) {
    const HalfSpace plane{pose.rotation * part.planes[f].normal, pose.scale * part.planes[f].offset};
    if (wall.solid_within) {
      const Real base = depth_below(plane, round.point), other = depth_below(plane, top);
      if (std::min(base, other) >= largest || std::max(base, other) <= -largest) continue;
    }
    placed_face(part, pose, f, buffer[0]);
    int current = 0;
    if (wall.kind != WallKind::sphere)
      for (const LocalHalfSpace& end : ends) {
        bool is_past = false;
        for (int c = 0; c < buffer[current].count; ++c) is_past |= depth_below(end, buffer[current].corner[c]) < 0;
        if (!is_past) continue;
        clip(buffer[current], end, buffer[1 - current]);
        current = 1 - current;
      }
    const FacePolygon& face = buffer[current];
    if (face.is_truncated) return false;
    bool touches = wall.solid_within && face.count > 0;
    for (int c = 0; c < face.count && !touches; ++c) touches = RoundLine(round, face.corner[c], {}).c > 0;
    if (touches) RoundFace<Integrals>(round, face, plane.normal, f < part.range.outer_face_count).add_to(integrals);
  }
  return true;
}

}  // namespace dem_gpu
