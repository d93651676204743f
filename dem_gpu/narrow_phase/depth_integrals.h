// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/narrow_phase/part_overlap.h"
#include "dem_gpu/narrow_phase/polygon_depth.h"

namespace dem_gpu {

/// What the depth potential needs of a contact, in a's unscaled body frame about a's centre, with psi = profile(depth):
///   force = integral over (b's surface in a) of psi_a n_b dA - integral over (a's surface in b) of psi_b n_a dA
/// and the moment likewise with x cross n. All faces of the parts enter: the two sides of a cut cancel where they meet,
/// and where they do not (a ledge) the bare strip counts, so the force is the gradient of the parts' energy whatever
/// the cut. Only outer faces weigh in the contact point, the depth and the patch sums (PatchSums where there is
/// friction).
template <class Profile, class Sums = NoPatchSums>
struct DepthIntegralsOf {
  static constexpr bool kNeedsDepth = true;
  static constexpr bool kHasPatch = std::is_same_v<Sums, PatchSums>;
  using PolygonSum = std::conditional_t<kHasPatch, PolygonPatchDepthOf<Profile>, PolygonDepthOf<Profile>>;

  Profile profile_a{}, profile_b{};  // of the fields of a and b, each in that body's unscaled frame

  Vec3 force;                 // [m3]
  Vec3 moment;                // [m4]
  Real weight = 0;            // integral of psi dA over both surfaces [m3]
  Vec3 weighted_point;        // integral of x psi dA [m4]
  bool is_truncated = false;  // a piece of a polygon did not fit
  /// b's inner faces are seams that wall b shares with others. Their part of the force, which the walls beyond balance,
  /// does not turn the contact's normal: a damper would brake what slides over a seam.
  bool has_seams = false;
  Vec3 seam_force;  // [m3]
  Sums patch;

  /// How the force changes when the other body moves, from the fields of one body: tangent = integral of minus gradient
  /// (psi) times n^T dA, and what goes with it.
  struct FieldSlope {
    Mat3 tangent;            // [m2]
    Vec3 area;               // vector area of the other body's surface inside, weighted by d psi / d depth [m2]
    Real largest_depth = 0;  // below planes [m]

    TALUS_HD FieldSlope() : tangent{{}, {}, {}} {}
    TALUS_HD void add(const Vec3& descent, const Vec3& area_vector, const Vec3& direction, Real largest) {
      tangent.column_x += direction.x * descent;
      tangent.column_y += direction.y * descent;
      tangent.column_z += direction.z * descent;
      area += area_vector;
      largest_depth = std::max(largest_depth, largest);
    }
    /// Change of the force along n over a shift along n [m2].
    TALUS_HD Real along(const Vec3& n) const { return std::abs(dot(n, tangent * n)); }
    /// Slope of the field along n, 1 for a face at right angles to it.
    TALUS_HD Real steepness(const Vec3& n) const {
      const Real projected = std::abs(dot(area, n)), change = along(n);
      return change >= projected ? Real(change > 0) : change / projected;
    }
  };
  FieldSlope field_a, field_b;

  TALUS_HD void add_surface_b(const Polygon& polygon, const LocalHalfSpace& plane_b, bool is_outer, const PartView& a,
                              const FrameChange& b_to_a) {
    const Vec3 normal = b_to_a.direction(plane_b.normal);
    const auto sum = integrate_depth<PolygonSum>(polygon, a.depth, rounded(normal), profile_a);
    is_truncated |= sum.is_truncated;
    const Vec3 depth_moment = sum.central_moment();
    add(sum.depth, depth_moment, normal, is_outer);
    if (has_seams && !is_outer) seam_force += sum.depth * normal;
    field_a.add(sum.descent, sum.area * normal, normal, is_outer ? sum.largest : 0);
    if constexpr (kHasPatch)
      if (is_outer) patch.add(patch.side_b, sum.depth, sum.aligned, normal, depth_moment, sum.central_second_moment());
  }

  TALUS_HD void add_surface_a(const Polygon& polygon, const LocalHalfSpace& plane_a, bool is_outer, const PartView& b,
                              const FrameChange& b_to_a) {
    const Vec3 normal = plane_a.normal;
    const auto sum =
        integrate_depth<PolygonSum>(polygon, b.depth, rounded(transpose_times(b_to_a.rotation, normal)), profile_b);
    is_truncated |= sum.is_truncated;
    const Real s = b_to_a.scale, cube = s * s * s;
    const Vec3 turned_moment = b_to_a.direction(sum.central_moment());
    const Vec3 moment_in_a = cube * (s * turned_moment + sum.depth * b_to_a.translation);
    add(cube * sum.depth, moment_in_a, -normal, is_outer);
    field_b.add((s * s) * b_to_a.direction(sum.descent), (s * s * sum.area) * normal, normal,
                is_outer ? s * sum.largest : 0);
    if constexpr (kHasPatch)
      if (is_outer) {
        const Vec3& shift = b_to_a.translation;
        const Real second = cube * (s * s * sum.central_second_moment() + 2 * s * dot(shift, turned_moment) +
                                    norm_squared(shift) * sum.depth);
        patch.add(patch.side_a, cube * sum.depth, cube * sum.aligned, -normal, moment_in_a, second);
      }
  }

  /// World-frame contact on body a; nothing if there is no overlap.
  template <class Law>
  TALUS_HD bool to_contact(const Law& law, const Pose& a, ElasticContact& contact) const {
    if (!(weight > 0)) return false;
    const Real square = a.scale * a.scale, cube = square * a.scale;
    contact.force = (law.stiffness * cube) * (a.rotation * force);
    contact.torque_a = (law.stiffness * cube * a.scale) * (a.rotation * moment);
    contact.point = a.position + a.rotation * ((a.scale / weight) * weighted_point);
    const Vec3 n = force_direction();
    if (!(norm_squared(n) > 0)) return false;
    contact.normal = -(a.rotation * n);
    contact.stiffness = law.stiffness * square * (field_a.along(n) + field_b.along(n));
    contact.depth = a.scale * depth_along(n);
    // Beyond the cap the force grows no more; the secant stands in for the tangent, which damping and friction divide
    // by.
    if (!(contact.stiffness > 0)) contact.stiffness = norm(contact.force) / contact.depth;
    return contact.depth > 0;
  }

  template <class Law>
  TALUS_HD ContactPatch to_patch(const Law& law, const Pose& a,
                                 const ElasticContact& /*contact*/) const requires kHasPatch {
    return {rotated(patch.normals(), a.rotation), law.stiffness * a.scale * a.scale * a.scale * patch.load(),
            a.scale * patch.lever(), law.stiffness_per_area()};
  }

  /// Of the force on a, what welded seams add left out; of friction's patches where their forces cancel, as in a slot;
  /// of a couple's forces where a body reaches through the other one and nothing but a couple is left. Zero where there
  /// is none.
  TALUS_HD Vec3 force_direction() const {
    Vec3 n = unit_or(force - seam_force, Vec3{});
    if constexpr (kHasPatch)
      if (!(norm_squared(n) > 0)) n = shared_normal(patch.normals());
    if (norm_squared(n) > 0 || !(norm_squared(moment) > 0)) return n;
    return any_perpendicular(unit_or(moment, Vec3{}));
  }

  /// Depth of the overlap along the force: the depth below the planes of the steeper field over its steepness there.
  TALUS_HD Real depth_along(const Vec3& n) const {
    // A sharp corner's own field climbs slowly; below this the quotient says nothing.
    constexpr Real kLeastSteepness = Real(0.25);
    const Real a = field_a.steepness(n), b = field_b.steepness(n);
    // Of a body within the other, flush with one of its faces, nothing lies below the other's surface.
    const bool takes_a = field_b.largest_depth > 0 ? field_a.largest_depth > 0 && a >= b : true;
    return takes_a ? field_a.largest_depth / std::max(a, kLeastSteepness)
                   : field_b.largest_depth / std::max(b, kLeastSteepness);
  }

 private:
  TALUS_HD void add(Real depth, const Vec3& depth_moment, const Vec3& direction, bool is_outer) {
    force += depth * direction;
    moment += cross(depth_moment, direction);
    if (!is_outer) return;
    weight += depth;
    weighted_point += depth_moment;
  }
};

using DepthIntegrals = DepthIntegralsOf<LinearProfile>;

}  // namespace dem_gpu
