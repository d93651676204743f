// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/core/scratch_array.h"
#include "dem_gpu/narrow_phase/part_frame.h"
#include "dem_gpu/narrow_phase/polygon_depth.h"
#include "dem_gpu/scene.h"
#include "dem_gpu/walls/curved_window.h"
#include "dem_gpu/walls/wall_patch_sums.h"
#include "dem_gpu/walls/wall_surface.h"

namespace dem_gpu {

/// Corner of a triangle with the wall's field there, position relative to the body's centre.
struct WallSample {
  LocalVec3 position;
  LocalWallField field;
};

/// Integrals of a wall's depth over the part of a body's surface inside the wall (all faces of its parts, see
/// DepthIntegrals), world frame about `centre`:
/// force direction = - integral of depth n dA. The wall's field alone carries the contact (U = 2 k integral of the
/// wall's depth over the overlap), so a flat face meets a wall as it meets another flat face. Planes are exact; on
/// curved walls each face is cut into pieces on which the depth is taken as linear (see kChordError). A hardening law
/// takes psi = profile(depth) in place of the depth.
template <class Profile, class Sums = NoPatchSums>
struct WallIntegralsOf {
  static constexpr bool kHasPatch = std::is_same_v<Sums, WallPatchSums>;

  Profile profile{};

  Vec3 force;           // [m3]
  Vec3 moment;          // [m4]
  Real weight = 0;      // [m3]
  Vec3 weighted_point;  // [m4]
  Vec3 area;            // vector area of the surface inside, weighted by d psi / d depth [m2]
  Real largest_depth = 0;
  Sums patch;

  TALUS_HD void add_triangle(const WallSample& a, const WallSample& b, const WallSample& c, const Vec3& normal,
                             bool is_outer) {
    constexpr int kMaxCorners = 6;  // a triangle cut by three fields
    WallSample buffer[2][kMaxCorners] = {{a, b, c}};
    int count = 3, current = 0;
    for (int field = 0; field < 3 && count >= 3; ++field) {
      const WallSample* from = buffer[current];
      WallSample* to = buffer[1 - current];
      int kept = 0;
      for (int i = 0; i < count; ++i) {
        const WallSample& here = from[i];
        const WallSample& next = from[(i + 1) % count];
        const LocalReal here_value = value(here, field), next_value = value(next, field);
        if (here_value >= 0) to[kept++] = here;
        if ((here_value > 0 && next_value < 0) || (here_value < 0 && next_value > 0))
          to[kept++] = between(here, next, here_value / (here_value - next_value));
      }
      count = kept;
      current = 1 - current;
    }
    for (int i = 2; i < count; ++i)
      add_linear(buffer[current][0], buffer[current][i - 1], buffer[current][i], normal, is_outer);
  }

  /// A polygon in the wall's depth below one plane, in the axes and about the point that the sums are in.
  TALUS_HD void add_polygon(const Polygon& polygon, const LocalHalfSpace& plane, const Vec3& normal, bool is_outer) {
    std::conditional_t<kHasPatch, PolygonPatchDepthOf<Profile>, PolygonDepthOf<Profile>> sum;
    sum.profile = profile;
    sum.origin = MomentOrigin::at(polygon.corner[0]);
    add_linear_depth(polygon, plane, rounded(normal), sum);
    const Real depth = sum.depth;
    const Vec3 depth_moment = sum.central_moment();
    force -= depth * normal;
    moment -= cross(depth_moment, normal);
    area += Real(sum.area) * normal;
    if (!is_outer) return;
    weight += depth;
    weighted_point += depth_moment;
    largest_depth = std::max(largest_depth, Real(sum.largest));
    if constexpr (kHasPatch) patch.add(depth, normal, plane.normal, sum.central_second_moment());
  }

  /// The same sums in axes turned by `rotation`.
  TALUS_HD void turn(const Mat3& rotation) {
    force = rotation * force;
    moment = rotation * moment;
    weighted_point = rotation * weighted_point;
    area = rotation * area;
    if constexpr (kHasPatch) patch.tensor = rotated(patch.tensor, rotation);
  }

  /// `stiffness`: of a flat face on the wall [N/m3].
  TALUS_HD bool to_contact(Real stiffness, const Vec3& centre, ElasticContact& contact) const {
    if (!(weight > 0)) return false;
    contact.force = stiffness * force;
    contact.torque_a = stiffness * moment;
    contact.point = centre + (1 / weight) * weighted_point;
    contact.stiffness = stiffness * norm(area);
    contact.depth = largest_depth;
    return set_normal(contact);
  }

  TALUS_HD ContactPatch to_patch(Real stiffness) const requires kHasPatch {
    const Real square = patch.second_moment / weight - norm_squared(weighted_point / weight);
    return {patch.normals(), stiffness * std::max(patch.load, Real(0)), std::sqrt(std::max(square, Real(0))),
            stiffness};
  }

 private:
  TALUS_HD static LocalReal value(const WallSample& sample, int field) {
    return field == 0 ? sample.field.depth : field == 1 ? sample.field.from_base : sample.field.from_top;
  }
  TALUS_HD static WallSample between(const WallSample& a, const WallSample& b, LocalReal t) {
    const auto mix = [&](LocalReal x, LocalReal y) { return x + t * (y - x); };
    return {a.position + t * (b.position - a.position),
            {mix(a.field.depth, b.field.depth), mix(a.field.from_base, b.field.from_base),
             mix(a.field.from_top, b.field.from_top)}};
  }
  TALUS_HD void add_linear(const WallSample& a, const WallSample& b, const WallSample& c, const Vec3& normal,
                           bool is_outer) {
    const MomentOrigin origin = MomentOrigin::at(a.position);
    const LocalReal triangle =
        LocalReal(0.5) * dot(cross(b.position - a.position, c.position - a.position), rounded(normal));
    const LocalReal da = a.field.depth, db = b.field.depth, dc = c.field.depth;
    const DepthTriangle piece{
        origin.to(a.position), origin.to(b.position), origin.to(c.position), da, db, dc, triangle};
    const TriangleIntegrals integrals = profile.integrate(piece);
    const Real depth = integrals.depth;
    const Vec3 depth_moment = origin.first_about_centre(integrals.depth_moment, integrals.depth);
    force -= depth * normal;
    moment -= cross(depth_moment, normal);
    area += Real(integrals.area) * normal;
    if (!is_outer) return;
    weight += depth;
    weighted_point += depth_moment;
    largest_depth = std::max(largest_depth, Real(std::max(da, std::max(db, dc))));
    if constexpr (kHasPatch) {
      if (!(depth > 0)) return;
      const LocalReal second = profile.second_moment(piece);
      patch.add(depth, normal, patch.wall_normal_at(depth_moment / depth),
                origin.second_about_centre(second, integrals.depth_moment, integrals.depth));
    }
  }
};

using WallIntegrals = WallIntegralsOf<LinearProfile>;

/// Chord error that a piece of a face may have against a curved wall, as a share of the part's radius.
constexpr Real kChordError = Real(0.002);
constexpr int kMostPieces = 8;  // of a triangle's edge
/// Where bodies are outside a ball or shaft, which may be small beside a face: the force of a face on a ball is then
/// short by at most 1 %.
constexpr int kMostPiecesOutside = 24;

/// Adds the triangle a, b, c of a flat face (relative to the body's centre) in pieces small enough for the wall's depth
/// to be linear on each: a chord of length h leaves a circle of radius R by h^2 / (8 R).
template <class Sampler, class Integrals>
TALUS_HD void add_in_pieces(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal, bool is_outer,
                            Real longest_piece, int most_pieces, const Sampler& sample, Integrals& integrals) {
  const Real longest = std::sqrt(std::max(norm_squared(b - a), std::max(norm_squared(c - a), norm_squared(c - b))));
  const int pieces =
      longest < most_pieces * longest_piece ? 1 + static_cast<int>(longest / longest_piece) : most_pieces;
  const Vec3 along_b = (Real(1) / pieces) * (b - a), along_c = (Real(1) / pieces) * (c - a);
  const auto corner = [&](int row, int column) {
    return sample(a + static_cast<Real>(row) * along_b + static_cast<Real>(column) * along_c);
  };
  for (int row = 0; row < pieces; ++row) {
    WallSample low = corner(row, 0), high = corner(row + 1, 0);
    for (int column = 0; column < pieces - row; ++column) {
      const WallSample next_low = corner(row, column + 1);
      integrals.add_triangle(low, high, next_low, normal, is_outer);
      if (column + 1 < pieces - row) {
        const WallSample next_high = corner(row + 1, column + 1);
        integrals.add_triangle(high, next_high, next_low, normal, is_outer);
        high = next_high;
      }
      low = next_low;
    }
  }
}

/// Length of the pieces in which the depth of a curved wall may be taken as linear [m].
TALUS_HD inline Real longest_piece_on(const WallRecord& wall, const Vec3& centre, Real radius) {
  const Real curvature_radius =
      wall.kind == WallKind::sphere ? wall.base_radius : axial_position(wall, centre).radius + radius;
  return std::sqrt(8 * kChordError * radius * curvature_radius);
}

/// Adds one convex part of a body at `pose` to the integrals of a plane, or of a curved wall with the bodies inside.
template <class Integrals>
TALUS_HD void integrate_part_in_wall(const PartView& part, const Pose& pose, const WallRecord& wall,
                                     Integrals& integrals) {
  const Vec3 centre = pose.scale * (pose.rotation * part.range.centre) + pose.position;
  const Real radius = pose.scale * part.range.radius;
  if (wall_field(wall, centre).depth + radius <= 0) return;
  const auto sample = [&](const Vec3& relative) {
    return WallSample{rounded(relative), local_wall_field(wall, pose.position + relative)};
  };
  ScratchArray<WallSample, kMaxPartVertices> vertices;
  bool touches = false;
  for (int v = 0; v < part.range.vertex_count; ++v) {
    vertices[v] = sample(pose.scale * (pose.rotation * part.vertices[v]));
    touches |= vertices[v].field.depth > 0;
  }
  if (!touches) return;
  const bool is_curved = wall.kind != WallKind::plane;
  const Real longest_piece = is_curved ? longest_piece_on(wall, centre, radius) : Real(0);
  for (int f = 0; f < part.range.face_count; ++f) {
    const bool is_outer = f < part.range.outer_face_count;
    const FaceCorners face = part.faces[f];
    const std::uint8_t* corner = part.corners + face.first;
    bool face_touches = false;
    for (int c = 0; c < face.count; ++c) face_touches |= vertices[corner[c]].field.depth > 0;
    if (!face_touches) continue;
    const Vec3 normal = pose.rotation * part.planes[f].normal;
    for (int c = 2; c < face.count; ++c) {
      const WallSample &first = vertices[corner[0]], &second = vertices[corner[c - 1]], &third = vertices[corner[c]];
      if (is_curved)
        add_in_pieces(first.position, second.position, third.position, normal, is_outer, longest_piece, kMostPieces,
                      sample, integrals);
      else
        integrals.add_triangle(first, second, third, normal, is_outer);
    }
  }
}

/// Adds one convex part of a body at `pose` to the integrals of a ball, shaft or cone with the bodies outside: each
/// face is first cut down to where the wall can reach it. False if a polygon was truncated.
template <class Integrals>
TALUS_HD bool integrate_part_outside(const PartView& part, const Pose& pose, const WallRecord& wall,
                                     Integrals& integrals) {
  const Vec3 centre = pose.scale * (pose.rotation * part.range.centre) + pose.position;
  const Real radius = pose.scale * part.range.radius;
  if (wall_field(wall, centre).depth + radius <= 0) return true;
  const auto sample = [&](const Vec3& relative) {
    return WallSample{rounded(relative), local_wall_field(wall, pose.position + relative)};
  };
  const Vec3 point = wall.point - pose.position;
  Polygon buffer[2];
  for (int f = 0; f < part.range.face_count; ++f) {
    const HalfSpace plane{pose.rotation * Vec3(part.planes[f].normal), pose.scale * part.planes[f].offset};
    const CurvedWindow window =
        wall.kind == WallKind::sphere ? ball_window(wall, point, plane) : shaft_window(wall, point, plane);
    if (window.is_empty) continue;
    const FaceCorners face = part.faces[f];
    int current = 0;
    buffer[0].count = face.count;
    buffer[0].is_truncated = false;
    for (int c = 0; c < face.count; ++c)
      buffer[0].corner[c] = rounded(pose.scale * (pose.rotation * part.vertices[part.corners[face.first + c]]));
    for (int side = 0; side < window.count; ++side, current = 1 - current)
      clip(buffer[current], window.side[side], buffer[1 - current]);
    const Polygon& polygon = buffer[current];
    if (polygon.is_truncated) return false;
    for (int c = 2; c < polygon.count; ++c)
      add_in_pieces(polygon.corner[0], polygon.corner[c - 1], polygon.corner[c], plane.normal,
                    f < part.range.outer_face_count, 2 * window.half_width / kMostPiecesOutside, kMostPiecesOutside,
                    sample, integrals);
  }
  return true;
}

}  // namespace dem_gpu
