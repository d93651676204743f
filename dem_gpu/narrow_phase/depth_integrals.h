// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/narrow_phase/part_overlap.h"
#include "dem_gpu/narrow_phase/patch_sums.h"

namespace dem_gpu {

/// Integrals of a depth field over one polygon, in the polygon's frame.
struct PolygonDepth {
  static constexpr bool kHasPatch = false;

  Real depth = 0;     // integral of depth dA [m3]
  Vec3 depth_moment;  // integral of x depth dA [m4]
  Vec3 descent;       // integral of minus the depth's gradient dA [m2]
  Real area = 0;      // [m2]
  Real largest = 0;   // largest depth at a corner [m]
};

/// With what friction needs.
struct PolygonPatchDepth : PolygonDepth {
  static constexpr bool kHasPatch = true;

  Real aligned = 0;        // the share of depth dA that meets the field at right angles [m3]
  Real second_moment = 0;  // integral of depth |x|^2 dA [m5]
};

/// Adds a polygon on which the depth is linear: closed form over the triangles of its fan.
template <class Sum>
TALUS_HD void add_linear_depth(const Polygon& polygon, const HalfSpace& plane, const Vec3& normal, Sum& sum) {
  const Real depth_before = sum.depth;
  const Vec3 a = polygon.corner[0];
  const Real depth_a = depth_below(plane, a);
  Vec3 b = polygon.corner[1];
  Real depth_b = depth_below(plane, b);
  sum.largest = std::max(sum.largest, std::max(depth_a, depth_b));
  for (int c = 2; c < polygon.count; ++c) {
    const Vec3 corner = polygon.corner[c];
    const Real depth_c = depth_below(plane, corner);
    const Real area = Real(0.5) * dot(cross(b - a, corner - a), normal);
    const Real total = depth_a + depth_b + depth_c;
    sum.area += area;
    sum.descent += area * plane.normal;
    sum.depth += area * total / 3;
    sum.depth_moment += (area / 12) * (depth_a * a + depth_b * b + depth_c * corner + total * (a + b + corner));
    sum.largest = std::max(sum.largest, depth_c);
    if constexpr (Sum::kHasPatch)
      sum.second_moment += second_moment_of_triangle(area, a, b, corner, depth_a, depth_b, depth_c);
    b = corner;
    depth_b = depth_c;
  }
  if constexpr (Sum::kHasPatch) sum.aligned += aligned_share(-dot(normal, plane.normal)) * (sum.depth - depth_before);
}

/// Integrates the least depth below `planes` over a polygon: one closed form where one plane is least at all corners,
/// else piece by piece over the cells in which each plane is the least. A piece may be cut by equal planes; the lower
/// index owns a tie.
template <class Sum>
TALUS_HD Sum integrate_depth(const Polygon& polygon, const HalfSpace* planes, int plane_count, const Vec3& normal) {
  Sum sum;
  // A plane is no candidate if another one is below it at every corner: it suffices to compare with the plane whose
  // largest depth is least.
  constexpr int kLargest = NearDepthPlanes::kLargest;
  ScratchArray<Real, kLargest> smallest;
  ScratchArray<std::int16_t, kLargest> candidate;
  Real least_largest = std::numeric_limits<Real>::max();
  int flattest = 0;
  for (int i = 0; i < plane_count; ++i) {
    Real low = depth_below(planes[i], polygon.corner[0]), high = low;
    for (int c = 1; c < polygon.count; ++c) {
      const Real depth = depth_below(planes[i], polygon.corner[c]);
      low = depth < low ? depth : low;
      high = depth > high ? depth : high;
    }
    smallest[i] = low;
    if (high < least_largest) least_largest = high, flattest = i;
  }
  int count = 0;
  for (int i = 0; i < plane_count; ++i)
    if (i == flattest || smallest[i] < least_largest) candidate[count++] = static_cast<std::int16_t>(i);
  if (count == 1) {
    add_linear_depth(polygon, planes[candidate[0]], normal, sum);
    return sum;
  }
  Polygon buffer[2];
  for (int k = 0; k < count; ++k) {
    const HalfSpace own = planes[candidate[k]];
    const Polygon* piece = &polygon;
    int next = 0;
    bool is_empty = false;
    for (int m = 0; m < count && !is_empty; ++m) {
      if (m == k) continue;
      const HalfSpace other = planes[candidate[m]];
      // own depth <= other depth, as a half-space
      const HalfSpace cell{other.normal - own.normal, other.offset - own.offset};
      bool all_inside = true, all_outside = true;
      for (int c = 0; c < piece->count; ++c) {
        const Real margin = depth_below(cell, piece->corner[c]);
        if (margin < 0) all_inside = false;
        if (margin > 0 || (margin == 0 && k < m)) all_outside = false;
      }
      if (all_outside) {
        is_empty = true;
      } else if (!all_inside) {
        clip(*piece, cell, buffer[next]);
        piece = &buffer[next];
        next = 1 - next;
        is_empty = piece->count == 0;
      }
    }
    if (!is_empty) add_linear_depth(*piece, own, normal, sum);
  }
  return sum;
}

/// What the depth potential needs of a contact, in a's unscaled body frame about a's centre:
///   force = integral over (b's surface in a) of depth_a n_b dA - integral over (a's surface in b) of depth_b n_a dA
/// and the moment likewise with x cross n. All faces of the parts enter: the two sides of a cut cancel where they meet,
/// and where they do not (a ledge) the bare strip counts, so the force is the gradient of the parts' energy whatever
/// the cut. Only outer faces weigh in the contact point, the depth and the patch
/// sums (PatchSums where there is friction, else NoPatchSums).
template <class Sums>
struct BasicDepthIntegrals {
  static constexpr bool kNeedsInnerFaces = true;
  static constexpr bool kNeedsDepthPlanes = true;
  static constexpr bool kHasPatch = std::is_same_v<Sums, PatchSums>;
  using PolygonSum = std::conditional_t<kHasPatch, PolygonPatchDepth, PolygonDepth>;

  Vec3 force;           // [m3]
  Vec3 moment;          // [m4]
  Real weight = 0;      // integral of depth dA over both surfaces [m3]
  Vec3 weighted_point;  // integral of x depth dA [m4]
  Sums patch;

  /// How the force changes when the other body moves, from the fields of one body: tangent = integral of minus gradient
  /// (depth) times n^T dA, and what goes with it.
  struct FieldSlope {
    Mat3 tangent;            // [m2]
    Vec3 area;               // vector area of the other body's surface inside [m2]
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
      const Real projected = std::abs(dot(area, n));
      return projected > 0 ? std::min(Real(1), along(n) / projected) : 0;
    }
  };
  FieldSlope field_a, field_b;

  TALUS_HD void add_surface_b(const Polygon& polygon, const HalfSpace& plane_b, bool is_outer, const PartView& a,
                              const FrameChange& b_to_a) {
    const Vec3 normal = b_to_a.direction(plane_b.normal);
    const auto sum = integrate_depth<PolygonSum>(polygon, a.depth_planes, a.depth_plane_count, normal);
    add(sum.depth, sum.depth_moment, normal, is_outer);
    field_a.add(sum.descent, sum.area * normal, normal, is_outer ? sum.largest : 0);
    if constexpr (kHasPatch)
      if (is_outer) patch.add(patch.side_b, sum.depth, sum.aligned, normal, sum.depth_moment, sum.second_moment);
  }

  TALUS_HD void add_surface_a(const Polygon& polygon, const HalfSpace& plane_a, bool is_outer, const PartView& b,
                              const FrameChange& b_to_a) {
    const Vec3 normal_in_b = transpose_times(b_to_a.rotation, plane_a.normal);
    const auto sum = integrate_depth<PolygonSum>(polygon, b.depth_planes, b.depth_plane_count, normal_in_b);
    const Real s = b_to_a.scale, cube = s * s * s;
    const Vec3 moment_in_a = cube * (s * b_to_a.direction(sum.depth_moment) + sum.depth * b_to_a.translation);
    add(cube * sum.depth, moment_in_a, -plane_a.normal, is_outer);
    field_b.add((s * s) * b_to_a.direction(sum.descent), (s * s * sum.area) * plane_a.normal, plane_a.normal,
                is_outer ? s * sum.largest : 0);
    if constexpr (kHasPatch)
      if (is_outer) {
        const Vec3& shift = b_to_a.translation;
        const Real second = cube * (s * s * sum.second_moment + 2 * s * dot(shift, b_to_a.direction(sum.depth_moment)) +
                                    norm_squared(shift) * sum.depth);
        patch.add(patch.side_a, cube * sum.depth, cube * sum.aligned, -plane_a.normal, moment_in_a, second);
      }
  }

  /// World-frame contact on body a; nothing if there is no overlap.
  TALUS_HD bool to_contact(const DepthPotential& law, const Pose& a, ElasticContact& contact) const {
    if (!(weight > 0)) return false;
    const Real square = a.scale * a.scale, cube = square * a.scale;
    contact.force = (law.stiffness * cube) * (a.rotation * force);
    contact.torque_a = (law.stiffness * cube * a.scale) * (a.rotation * moment);
    contact.point = a.position + a.rotation * ((a.scale / weight) * weighted_point);
    if (!set_normal(contact)) return false;
    const Vec3 n = unit_or(force, {0, 0, 1});
    contact.stiffness = law.stiffness * square * (field_a.along(n) + field_b.along(n));
    contact.depth = a.scale * depth_along(n);
    return contact.stiffness > 0;
  }

  TALUS_HD void to_patch(const DepthPotential& law, const Pose& a, const ElasticContact& /*contact*/,
                         ContactPatch& result) const requires kHasPatch {
    result.normals = rotated(patch.normals(), a.rotation);
    result.load = law.stiffness * a.scale * a.scale * a.scale * patch.load();
    result.lever = a.scale * patch.lever();
    result.stiffness_per_area = law.stiffness_per_area();
  }

  /// Depth of the overlap along the force: the depth below the planes of the steeper field over its steepness there.
  TALUS_HD Real depth_along(const Vec3& n) const {
    // A sharp corner's own field climbs slowly; below this the quotient says nothing.
    constexpr Real kLeastSteepness = Real(0.25);
    const Real a = field_a.steepness(n), b = field_b.steepness(n);
    return a >= b ? field_a.largest_depth / std::max(a, kLeastSteepness)
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
using DepthIntegrals = BasicDepthIntegrals<NoPatchSums>;

}  // namespace dem_gpu
