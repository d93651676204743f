// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "dem_gpu/contacts/contact_patch.h"
#include "dem_gpu/core/quaternion.h"

namespace dem_gpu {

/// Adds w n n^T.
TALUS_HD inline void add_outer_product(Mat3& sum, Real w, const Vec3& n) {
  sum.column_x += (w * n.x) * n;
  sum.column_y += (w * n.y) * n;
  sum.column_z += (w * n.z) * n;
}
TALUS_HD inline Mat3 weighted_sum(Real wa, const Mat3& a, Real wb, const Mat3& b) {
  return {wa * a.column_x + wb * b.column_x, wa * a.column_y + wb * b.column_y, wa * a.column_z + wb * b.column_z};
}
/// R T R^T: a symmetric tensor seen from another frame.
TALUS_HD inline Mat3 rotated(const Mat3& tensor, const Mat3& r) {
  const Mat3 half{r * tensor.column_x, r * tensor.column_y, r * tensor.column_z};
  return {half * Vec3{r.column_x.x, r.column_y.x, r.column_z.x}, half * Vec3{r.column_x.y, r.column_y.y, r.column_z.y},
          half * Vec3{r.column_x.z, r.column_y.z, r.column_z.z}};
}

/// The direction that patches' normals share, of either sign, from the load-weighted mean of n n^T; zero without a
/// load.
TALUS_HD inline Vec3 shared_normal(const Mat3& normals) {
  Vec3 longest = normals.column_x;
  if (norm_squared(normals.column_y) > norm_squared(longest)) longest = normals.column_y;
  if (norm_squared(normals.column_z) > norm_squared(longest)) longest = normals.column_z;
  return unit_or(longest, Vec3{});
}

/// Share of a piece of surface that counts as a flat contact of its own: it meets the other body's field at right
/// angles. 1 for face on face, 0 from 18 degrees on, without a jump between (a cube's corner on a face meets it at 55
/// degrees).
TALUS_HD inline Real aligned_share(Real cosine) {
  constexpr Real kPointed = Real(0.95), kFlat = Real(0.99);
  const Real t = std::min(std::max((cosine - kPointed) / (kFlat - kPointed), Real(0)), Real(1));
  return t * t * (3 - 2 * t);
}

/// Surface of one body inside the other, as one contact, along the sum of its normals.
struct WholeSide {
  Vec3 total;  // sum of weight n
  Real weight = 0;

  TALUS_HD void add(Real w, const Vec3& weighted_n) {
    total += weighted_n;
    weight += w;
  }
  /// 1 for a plane, 0.71 for a right-angled corner pressed evenly.
  TALUS_HD Real flatness() const { return weight > 0 ? norm(total) / weight : 0; }
};

/// The same, its flat patches as contacts of their own.
struct PatchSide : WholeSide {
  Mat3 tensor{{}, {}, {}};  // sum of aligned weight n n^T
  Real aligned = 0;         // sum of aligned weight
  Vec3 pointed;             // sum of n times the weight that is not aligned: one contact, a corner or an edge

  TALUS_HD void add(Real w, Real aligned_w, const Vec3& n) {
    add_outer_product(tensor, aligned_w, n);
    aligned += aligned_w;
    pointed += (w - aligned_w) * n;
    WholeSide::add(w, w * n);
  }
  TALUS_HD Mat3 normals() const {
    Mat3 sum = tensor;
    const Real length = norm(pointed), load = aligned + length;
    if (!(load > 0)) return sum;
    if (length > 0) add_outer_product(sum, 1 / length, pointed);
    return weighted_sum(1 / load, sum, 0, sum);
  }
};

/// What friction needs of a contact's surfaces, in a's unscaled body frame about a's centre. Sums over outer faces
/// only, additive over parts and over pieces of a face, so they do not depend on the cut.
template <class Side>
struct PatchSumsOf {
  Side side_a, side_b;     // n: direction of the force on a
  Real weight = 0;         // both sides: integral of depth dA, under the volume law the area
  Vec3 first_moment;       // so weighted, of x
  Real second_moment = 0;  // of |x|^2

  /// The flatter side tells the normals (a corner on a face: the face), without a jump where the sides change places:
  /// how much of them a's side tells.
  TALUS_HD Real share_of_a() const {
    constexpr Real kMargin = Real(0.1);
    const Real ahead = (side_a.flatness() - side_b.flatness()) / kMargin;
    return Real(0.5) + Real(0.5) * std::min(std::max(ahead, Real(-1)), Real(1));
  }

  TALUS_HD Real lever() const {
    if (!(weight > 0)) return 0;
    return std::sqrt(std::max(second_moment / weight - norm_squared(first_moment / weight), Real(0)));
  }
};

struct PatchSums : PatchSumsOf<PatchSide> {
  TALUS_HD void add(PatchSide& side, Real w, Real aligned_w, const Vec3& direction, const Vec3& first, Real second) {
    side.add(w, aligned_w, direction);
    weight += w;
    first_moment += first;
    second_moment += second;
  }

  /// Sum of the patches' loads: equal to the weight of the force wherever all of the contact has one normal.
  TALUS_HD Real load() const { return side_a.aligned + side_b.aligned + norm(side_a.pointed + side_b.pointed); }

  TALUS_HD Mat3 normals() const {
    const Real share = share_of_a();
    return weighted_sum(share, side_a.normals(), 1 - share, side_b.normals());
  }
};

/// Under the volume law.
struct AreaPatchSums : PatchSumsOf<WholeSide> {
  /// In the frame that a's is turned into by a rotation.
  TALUS_HD Mat3 normals(const Mat3& rotation) const {
    const Real share = share_of_a();
    Mat3 sum{{}, {}, {}};
    add_outer_product(sum, share, rotation * unit_or(side_a.total, Vec3{}));
    add_outer_product(sum, 1 - share, rotation * unit_or(side_b.total, Vec3{}));
    return sum;
  }
};

/// Sums for a scene without friction: none.
struct NoPatchSums {};

template <class Patch>
using PatchSumsFor = std::conditional_t<std::is_same_v<Patch, NoPatch>, NoPatchSums, PatchSums>;

}  // namespace dem_gpu
