// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/core/scratch_array.h"
#include "dem_gpu/narrow_phase/part_frame.h"
#include "dem_gpu/narrow_phase/polygon_depth.h"
#include "dem_gpu/scene.h"
#include "dem_gpu/walls/wall_patch_sums.h"
#include "dem_gpu/walls/wall_surface.h"

namespace dem_gpu {

/// Corner of a triangle with the depth below a plane there, position relative to the body's centre.
struct WallSample {
  LocalVec3 position;
  LocalReal depth = 0;  // [m]
};

/// Integrals over a small piece of the body's surface, about `centre`.
struct WallPiece {
  Real depth;          // of psi [m3]
  Vec3 depth_moment;   // of x psi [m4]
  Real area;           // of d psi / d depth [m2]
  Real second_moment;  // of psi |x|^2, with friction [m5]
};

/// Integrals of a wall's depth over the part of a body's surface inside the wall (all faces of its parts, see
/// DepthIntegrals), world frame about `centre`:
/// force direction = - integral of depth n dA. The wall's field alone carries the contact (U = 2 k integral of the
/// wall's depth over the overlap), so a flat face meets a wall as it meets another flat face. A hardening law takes
/// psi = profile(depth) in place of the depth.
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

  /// A triangle of a face in the depth below a plane with the normal `along`.
  TALUS_HD void add_triangle(const WallSample& a, const WallSample& b, const WallSample& c, const Vec3& normal,
                             const Vec3& along, bool is_outer) {
    constexpr int kMaxCorners = 4;  // a triangle cut once
    const WallSample from[3] = {a, b, c};
    WallSample kept[kMaxCorners];
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      const WallSample& here = from[i];
      const WallSample& next = from[(i + 1) % 3];
      if (here.depth >= 0) kept[count++] = here;
      if ((here.depth > 0 && next.depth < 0) || (here.depth < 0 && next.depth > 0))
        kept[count++] = between(here, next, here.depth / (here.depth - next.depth));
    }
    for (int i = 2; i < count; ++i) add_linear(kept[0], kept[i - 1], kept[i], normal, along, is_outer);
  }

  /// A polygon in the wall's depth below one plane, in the axes and about the point that the sums are in.
  TALUS_HD void add_polygon(const Polygon& polygon, const LocalHalfSpace& plane, const Vec3& normal, bool is_outer) {
    std::conditional_t<kHasPatch, PolygonPatchDepthOf<Profile>, PolygonDepthOf<Profile>> sum;
    sum.profile = profile;
    sum.origin = MomentOrigin::at(polygon.corner(0));
    add_linear_depth(polygon, plane, rounded(normal), sum);
    WallPiece piece{sum.depth, sum.central_moment(), sum.area, 0};
    if constexpr (kHasPatch) piece.second_moment = sum.central_second_moment();
    if (is_outer) reach(sum.largest);
    add_piece(piece, normal, plane.normal, is_outer);
  }

  /// `along`: the wall's normal there.
  TALUS_HD void add_piece(const WallPiece& piece, const Vec3& normal, const Vec3& along, bool is_outer) {
    force -= piece.depth * normal;
    moment -= cross(piece.depth_moment, normal);
    area += piece.area * normal;
    if (!is_outer) return;
    weight += piece.depth;
    weighted_point += piece.depth_moment;
    if constexpr (kHasPatch) patch.add(piece.depth, normal, along, piece.second_moment);
  }
  TALUS_HD void reach(Real depth) { largest_depth = std::max(largest_depth, depth); }

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
    if (set_normal(contact)) return true;
    if constexpr (kHasPatch) contact.normal = shared_normal(patch.normals());  // a slot: the forces cancel
    return norm_squared(contact.normal) > 0;
  }

  TALUS_HD ContactPatch to_patch(Real stiffness) const requires kHasPatch {
    const Real square = patch.second_moment / weight - norm_squared(weighted_point / weight);
    return {patch.normals(), stiffness * std::max(patch.load, Real(0)), std::sqrt(std::max(square, Real(0))),
            stiffness};
  }

 private:
  TALUS_HD static WallSample between(const WallSample& a, const WallSample& b, LocalReal t) {
    return {a.position + t * (b.position - a.position), a.depth + t * (b.depth - a.depth)};
  }
  TALUS_HD void add_linear(const WallSample& a, const WallSample& b, const WallSample& c, const Vec3& normal,
                           const Vec3& along, bool is_outer) {
    const MomentOrigin origin = MomentOrigin::at(a.position);
    const LocalReal triangle =
        LocalReal(0.5) * dot(cross(b.position - a.position, c.position - a.position), rounded(normal));
    const DepthTriangle corners{
        origin.to(a.position), origin.to(b.position), origin.to(c.position), a.depth, b.depth, c.depth, triangle};
    const TriangleIntegrals sum = profile.integrate(corners);
    if (is_outer) reach(std::max(a.depth, std::max(b.depth, c.depth)));
    WallPiece piece{sum.depth, origin.first_about_centre(sum.depth_moment, sum.depth), sum.area, 0};
    if constexpr (kHasPatch)
      piece.second_moment = origin.second_about_centre(profile.second_moment(corners), sum.depth_moment, sum.depth);
    add_piece(piece, normal, along, is_outer);
  }
};

using WallIntegrals = WallIntegralsOf<LinearProfile>;

/// Adds one convex part of a body at `pose` to the integrals of a plane.
template <class Integrals>
TALUS_HD void integrate_part_in_plane(const PartView& part, const Pose& pose, const WallRecord& wall,
                                      Integrals& integrals) {
  const Vec3 centre = pose.scale * (pose.rotation * part.range.centre) + pose.position;
  if (wall_field(wall, centre).depth + pose.scale * part.range.radius <= 0) return;
  ScratchArray<WallSample, kMaxPartVertices> vertices;
  bool touches = false;
  for (int v = 0; v < part.range.vertex_count; ++v) {
    const Vec3 relative = pose.scale * (pose.rotation * part.vertices[v]);
    vertices[v] = {rounded(relative), rounded(wall_field(wall, pose.position + relative).depth)};
    touches |= vertices[v].depth > 0;
  }
  if (!touches) return;
  for (int f = 0; f < part.range.face_count; ++f) {
    const FaceCorners face = part.faces[f];
    const std::uint8_t* corner = part.corners + face.first;
    bool face_touches = false;
    for (int c = 0; c < face.count; ++c) face_touches |= vertices[corner[c]].depth > 0;
    if (!face_touches) continue;
    const Vec3 normal = pose.rotation * part.planes[f].normal;
    for (int c = 2; c < face.count; ++c)
      integrals.add_triangle(vertices[corner[0]], vertices[corner[c - 1]], vertices[corner[c]], normal, wall.direction,
                             f < part.range.outer_face_count);
  }
}

}  // namespace dem_gpu
