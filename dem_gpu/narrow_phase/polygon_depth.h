// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "dem_gpu/narrow_phase/depth_profile.h"
#include "dem_gpu/narrow_phase/least_depth.h"
#include "dem_gpu/narrow_phase/moment_origin.h"
#include "dem_gpu/narrow_phase/near_depth.h"
#include "dem_gpu/narrow_phase/patch_sums.h"
#include "dem_gpu/narrow_phase/polygon.h"

namespace dem_gpu {

/// Integrals of a depth field over one polygon, in the polygon's frame. With psi the profile of the depth (the depth
/// itself where the law is linear):
template <class Profile>
struct PolygonDepthOf {
  static constexpr bool kHasPatch = false;

  Profile profile{};
  MomentOrigin origin{};  // of x

  LocalReal depth = 0;        // integral of psi dA [m3]
  LocalVec3 depth_moment;     // integral of x psi dA [m4]
  LocalVec3 descent;          // integral of minus the gradient of psi dA [m2]
  LocalReal area = 0;         // integral of d psi / d depth dA [m2]
  LocalReal largest = 0;      // largest depth at a corner [m]
  bool is_truncated = false;  // a corner of a piece did not fit

  /// Integral of x psi dA about the centre of the frame [m4].
  TALUS_HD Vec3 central_moment() const { return origin.first_about_centre(depth_moment, depth); }
};
using PolygonDepth = PolygonDepthOf<LinearProfile>;

/// With what friction needs.
template <class Profile>
struct PolygonPatchDepthOf : PolygonDepthOf<Profile> {
  static constexpr bool kHasPatch = true;

  LocalReal aligned = 0;        // the share of psi dA that meets the field at right angles [m3]
  LocalReal second_moment = 0;  // integral of psi |x|^2 dA [m5]

  /// Integral of psi |x|^2 dA about the centre of the frame [m5].
  TALUS_HD Real central_second_moment() const {
    return this->origin.second_about_centre(second_moment, this->depth_moment, this->depth);
  }
};

/// Adds a polygon on which the depth is linear: closed form over the triangles of its fan, a lane each. (Lanes beyond
/// the last triangle have two corners in one place, so no area.)
template <class Sum>
TALUS_HD TALUS_DEVICE_CALL void add_linear_depth(const Polygon& polygon, const LocalHalfSpace& plane,
                                                 const LocalVec3& normal, Sum& sum) {
  const Lanes depths = depths_below(plane, polygon.corners);
  const LaneVec3 corners = sum.origin.to(polygon.corners);
  DepthTriangles fan{first_lane(corners), corners, next_lane(corners), first_lane(depths), depths,
                     next_lane(depths),   {}};
  fan.area = LocalReal(0.5) * dot(normal, cross(fan.b - fan.a, fan.c - fan.a));
  const auto integrals = sum.profile.integrate(fan);
  Lanes second{};
  if constexpr (Sum::kHasPatch) second = sum.profile.second_moment(fan);
  const LaneVec3& moment = integrals.depth_moment;
  const Lanes sums[kLanes] = {integrals.depth, integrals.area, moment.x, moment.y, moment.z, second, {}, {}};
  const Lanes total = sums_of_lanes(sums);
  sum.depth += total[0];
  sum.area += total[1];
  sum.descent += LocalReal(total[1]) * plane.normal;
  sum.depth_moment += LocalVec3{total[2], total[3], total[4]};
  sum.largest = std::max(sum.largest, greatest_lane(depths));
  if constexpr (Sum::kHasPatch) {
    sum.second_moment += total[5];
    sum.aligned += rounded(aligned_share(-dot(normal, plane.normal))) * total[0];
  }
}

/// Adds the least depth below `planes` over a polygon.
template <class Sum>
TALUS_HD void add_least_depth(const Polygon& polygon, const LocalHalfSpace* planes, int plane_count,
                              const LocalVec3& normal, Sum& sum) {
  visit_least_depth(polygon, planes, plane_count, [&](const Polygon& piece, const LocalHalfSpace& plane) {
    if (piece.is_truncated) sum.is_truncated = true;
    add_linear_depth(piece, plane, normal, sum);
  });
}

/// A depth field over one polygon: its planes, and the terms that change from one of their planes to another there.
/// What lies nowhere in a ball about the polygon is left out first, then what lies nowhere on the polygon itself: a
/// plane is least at a corner, and so is the largest value of a term, which is convex.
struct FieldOnPolygon {
  ScratchArray<LocalHalfSpace, kMostPlanesOnPolygon> plane;  // room for one a term at the end
  int plane_count = 0;
  ScratchArray<DepthTerm, kMostTermsOnPolygon> term;
  int term_count = 0;
  ScratchArray<LocalHalfSpace, kMostTermPlanesOnPolygon> term_plane;
  bool is_truncated = false;  // the polygon is too large for the field: it has more parts than fit

  TALUS_HD FieldOnPolygon(const Polygon& polygon, const DepthField& field) {
    const LocalBall ball = ball_about(polygon);
    const LocalReal limit = greatest_possible(ball, field);
    ScratchArray<LocalReal, NearField::kMostPlanes> least;  // of each plane on the polygon
    LocalReal bound = limit;                                // the field is nowhere on the polygon greater
    for (int i = 0; i < field.plane_count && !is_truncated; ++i) {
      if (depth_below(field.planes[i], ball.centre) - ball.radius > limit) continue;
      const DepthRange depths = depth_range(polygon, field.planes[i]);
      if (depths.shallowest > bound) continue;
      bound = std::min(bound, depths.deepest);
      is_truncated = plane_count == NearField::kMostPlanes;
      if (is_truncated) break;
      least[plane_count] = depths.shallowest;
      plane[plane_count++] = field.planes[i];
    }
    NearTerms near;
    for (int t = 0; t < field.term_count && !is_truncated; ++t) {
      if (!is_within(field, t, ball, limit)) continue;
      const DepthRange depths =
          term_range(field, t, [&](const LocalHalfSpace& below) { return depth_range(polygon, below); });
      if (depths.shallowest > bound) continue;
      bound = std::min(bound, depths.deepest);
      is_truncated = near.count == kMostPlanesOnPolygon;
      if (is_truncated) break;
      near.least[near.count] = depths.shallowest;
      near.term[near.count++] = field.terms[t];
    }
    if (!is_truncated) keep_up_to(bound, polygon, field.term_planes, least, near);
  }

 private:
  /// Terms near the polygon, most of which are one plane there.
  struct NearTerms {
    ScratchArray<DepthTerm, kMostPlanesOnPolygon> term;
    ScratchArray<LocalReal, kMostPlanesOnPolygon> least;  // on the polygon
    int count = 0;
  };

  /// About a middle of the corners: the first counts for the lanes it fills.
  TALUS_HD static LocalBall ball_about(const Polygon& polygon) {
    const LocalVec3 centre = sum_of_lanes(polygon.corners) / LocalReal(kLanes);
    return {centre, std::sqrt(greatest_lane(norm_squared(polygon.corners - centre)))};
  }

  /// Leaves out what is nowhere less deep than `bound`.
  TALUS_HD void keep_up_to(LocalReal bound, const Polygon& polygon, const LocalHalfSpace* term_planes,
                           const ScratchArray<LocalReal, NearField::kMostPlanes>& least, const NearTerms& near) {
    int kept = 0;
    for (int i = 0; i < plane_count; ++i)
      if (least[i] <= bound) plane[kept++] = plane[i];
    plane_count = kept;
    int used = 0;
    for (int k = 0; k < near.count && !is_truncated; ++k) {
      if (near.least[k] > bound) continue;
      const int count = near.term[k].count;
      is_truncated = plane_count + term_count + 1 > kMostPlanesOnPolygon || term_count == kMostTermsOnPolygon ||
                     used + count > kMostTermPlanesOnPolygon;
      if (!is_truncated) used += add_term(polygon, term_planes + near.term[k].first, count, used);
    }
  }

  /// True if plane k is nowhere on the polygon the greatest of the term; of equal ones the lowest index stays.
  TALUS_HD static bool is_outdone(const Polygon& polygon, const LocalHalfSpace* planes, int count, int k) {
    const Lanes own = depths_below(planes[k], polygon.corners);
    for (int i = 0; i < count; ++i) {
      if (i == k) continue;
      const Lanes other = depths_below(planes[i], polygon.corners);
      const LaneSet all = (1u << kLanes) - 1;
      if (i < k ? lanes_above(own, other) == 0 : lanes_above(other, own) == all) return true;
    }
    return false;
  }

  /// Returns how many term planes were taken up.
  TALUS_HD int add_term(const Polygon& polygon, const LocalHalfSpace* planes, int count, int first) {
    int kept = 0;
    for (int k = 0; k < count; ++k)
      if (!is_outdone(polygon, planes, count, k)) term_plane[first + kept++] = planes[k];
    if (kept == 1) {
      plane[plane_count++] = term_plane[first];
      return 0;
    }
    term[term_count++] = {first, kept};
    return kept;
  }
};

/// Adds a depth field over a polygon. Where terms change over between their planes the polygon is cut into the convex
/// pieces on which each term is one plane: every choice of one plane a term is tried, dropping all choices that begin
/// with one whose piece is empty.
template <class Sum>
TALUS_HD TALUS_DEVICE_CALL void add_depth(const Polygon& polygon, FieldOnPolygon& here, const LocalVec3& normal,
                                          Sum& sum) {
  ScratchArray<std::uint8_t, kMostTermsOnPolygon> choice;
  for (int t = 0; t < here.term_count; ++t) choice[t] = 0;
  while (true) {
    ShrinkingPolygon shrinking{polygon};
    HalvesToCut halves;
    std::uint64_t next_cut = 0;  // (level << 32) | plane of its term
    int reached = -1;            // the deepest level that a piece of this choice came to
    do {
      int level = static_cast<int>(next_cut >> 32), k = static_cast<int>(next_cut & 0xffffffff);
      for (; level < here.term_count; ++level, k = 0) {
        const LocalHalfSpace* planes = here.term_plane.data() + here.term[level].first;
        const int chosen = choice[level];
        while (k < here.term[level].count && !shrinking.is_empty && !shrinking.piece.is_truncated) {
          if (k == chosen || shrinking.keep(lower_side(planes[k], planes[chosen]), chosen < k))
            ++k;
          else
            halves.split(shrinking, static_cast<std::uint64_t>(level) << 32 | static_cast<std::uint64_t>(k));
        }
        if (shrinking.is_empty) break;
        here.plane[here.plane_count + level] = planes[chosen];
      }
      reached = std::max(reached, std::min(level, here.term_count - 1));
      if (shrinking.is_empty) continue;
      if (shrinking.piece.is_truncated) sum.is_truncated = true;
      add_least_depth(shrinking.piece, here.plane.data(), here.plane_count + here.term_count, normal, sum);
    } while (halves.next(shrinking, next_cut));
    while (reached >= 0 && ++choice[reached] == here.term[reached].count) choice[reached--] = 0;
    if (reached < 0) return;
  }
}

/// A square grid over a polygon.
class PolygonGrid {
 public:
  TALUS_HD PolygonGrid(const Polygon& polygon, const LocalVec3& normal, int across)
      : across_(across), axis_{unit_or(polygon.corner(1) - polygon.corner(0), {1, 0, 0}), {}} {
    axis_[1] = cross(normal, axis_[0]);
    for (int k = 0; k < 2; ++k) {
      const Lanes along = dot(axis_[k], polygon.corners);
      low_[k] = least_lane(along);
      high_[k] = greatest_lane(along);
    }
  }

  /// The part of the polygon in cell (i, j); false if it has more corners than fit. Cells share the lines between them,
  /// bit for bit.
  TALUS_HD bool cut_to_cell(ShrinkingPolygon& polygon, int i, int j) const {
    const int index[2] = {i, j};
    bool fits = true;
    for (int k = 0; k < 2 && fits && !polygon.is_empty; ++k) {
      if (index[k] > 0) fits = polygon.keep({-axis_[k], -line(k, index[k])}, false);
      if (index[k] < across_ - 1 && fits && !polygon.is_empty)
        fits = polygon.keep({axis_[k], line(k, index[k] + 1)}, true);
    }
    return fits;
  }

 private:
  TALUS_HD LocalReal line(int k, int at) const { return low_[k] + at * ((high_[k] - low_[k]) / across_); }

  int across_;
  LocalVec3 axis_[2];
  LocalReal low_[2], high_[2];
};

/// Adds a field over a polygon as a whole; false if it has more parts there, or one of more corners, than fit.
template <class Sum>
TALUS_HD TALUS_DEVICE_CALL bool add_depth_at_once(const Polygon& polygon, const DepthField& field,
                                                  const LocalVec3& normal, Sum& sum) {
  if (field.term_count == 0 && field.plane_count <= NearField::kMostPlanes) {
    add_least_depth(polygon, field.planes, field.plane_count, normal, sum);
    return !sum.is_truncated;
  }
  FieldOnPolygon here(polygon, field);
  if (here.is_truncated) return false;
  add_depth(polygon, here, normal, sum);
  return !sum.is_truncated;
}

/// Adds a field over a polygon too large for it, cell by cell; false if it does not fit a cell.
template <class Sum>
TALUS_HD bool add_depth_by_cells(const Polygon& polygon, const DepthField& field, const LocalVec3& normal, int across,
                                 Sum& sum) {
  const PolygonGrid grid(polygon, normal, across);
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j) {
      ShrinkingPolygon cell{polygon};
      if (!grid.cut_to_cell(cell, i, j)) return false;
      if (!cell.is_empty && !add_depth_at_once(cell.piece, field, normal, sum)) return false;
    }
  return true;
}

/// Integrates a depth field over a polygon.
template <class Sum, class Profile>
TALUS_HD TALUS_DEVICE_CALL Sum integrate_depth(const Polygon& polygon, const DepthField& field, const LocalVec3& normal,
                                               const Profile& profile) {
  Sum empty;
  empty.profile = profile;
  empty.origin = MomentOrigin::at(polygon.corner(0));
  Sum sum = empty;
  if (add_depth_at_once(polygon, field, normal, sum)) return sum;
  // Halves have room for more corners.
  constexpr int kMostAcross = 32;
  for (int across = 1; across <= kMostAcross; across *= 2) {
    sum = empty;
    const bool fits = polygon.count > 4 ? add_depth_by_cells(half_of(polygon, false), field, normal, across, sum) &&
                                              add_depth_by_cells(half_of(polygon, true), field, normal, across, sum)
                                        : add_depth_by_cells(polygon, field, normal, across, sum);
    if (fits) return sum;
  }
  sum.is_truncated = true;
  return sum;
}

}  // namespace dem_gpu
