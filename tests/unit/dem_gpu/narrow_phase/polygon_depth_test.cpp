// SPDX-License-Identifier: Apache-2.0
// Depth fields over one polygon against sums over a fine grid.
#include "dem_gpu/narrow_phase/polygon_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/precision.h"

namespace {

using dem_gpu::DepthField;
using dem_gpu::DepthTerm;
using dem_gpu::kLanes;
using dem_gpu::LinearProfile;
using dem_gpu::LocalHalfSpace;
using dem_gpu::LocalReal;
using dem_gpu::Polygon;
using dem_gpu::PolygonDepth;
using dem_gpu::Real;
using dem_gpu::rounded;
using dem_gpu::Vec3;
using test_support::kSingle;

constexpr Vec3 kSpot{0.1, -0.07, 0};

/// Two by two, about the origin, at z = 0.
Polygon square() {
  constexpr LocalReal kX[] = {-1, 1, 1, -1}, kY[] = {-1, -1, 1, 1};
  LocalReal x[kLanes], y[kLanes], z[kLanes]{};
  for (int i = 0; i < kLanes; ++i) x[i] = kX[i < 4 ? i : 0], y[i] = kY[i < 4 ? i : 0];
  return {dem_gpu::load_points(x, y, z), 4};
}

/// Pits with a flat bottom of many sides that lie on one spot, each a term: `sides` planes that rise from the bottom's
/// edges, and the bottom's own.
struct Pits {
  std::vector<LocalHalfSpace> planes{rounded(dem_gpu::HalfSpace{{}, 100})}, term_planes;
  std::vector<DepthTerm> terms;

  Pits(int count, int sides, Real bottom_radius) {
    for (int t = 0; t < count; ++t) {
      const Real depth = 0.5 + 0.002 * t, slope = 0.3 - 0.05 * t, turn = 0.7 * t;
      terms.push_back({static_cast<int>(term_planes.size()), sides + 1});
      term_planes.push_back(rounded(dem_gpu::HalfSpace{{}, depth}));
      for (int i = 0; i < sides; ++i) {
        const Real angle = turn + 2 * std::numbers::pi * i / sides;
        const Vec3 outwards{std::cos(angle), std::sin(angle), 0};
        term_planes.push_back(
            rounded(dem_gpu::HalfSpace{-slope * outwards, depth - slope * (bottom_radius + dot(outwards, kSpot))}));
      }
    }
  }
  DepthField field() const {
    return {planes.data(), static_cast<int>(planes.size()), terms.data(), static_cast<int>(terms.size()),
            term_planes.data()};
  }
  Real depth_at(const Vec3& x) const {
    Real least = 100;
    for (const DepthTerm& term : terms) {
      Real greatest = 0;
      for (int i = term.first; i < term.first + term.count; ++i)
        greatest = std::max(greatest, term_planes[i].offset - dot(Vec3(term_planes[i].normal), x));
      least = std::min(least, greatest);
    }
    return least;
  }
};

/// Of depth and of x times depth over the square.
struct GridSums {
  Real depth = 0;
  Vec3 moment;

  explicit GridSums(const Pits& pits) {
    constexpr int kAcross = 1500;
    constexpr Real kCell = Real(2) / kAcross;
    for (int i = 0; i < kAcross; ++i)
      for (int j = 0; j < kAcross; ++j) {
        const Vec3 x{-1 + (i + 0.5) * kCell, -1 + (j + 0.5) * kCell, 0};
        const Real here = kCell * kCell * pits.depth_at(x);
        depth += here;
        moment += here * x;
      }
  }
};

// A piece on which all terms are one plane each may have more corners than a polygon holds, however small the polygon.
TEST(PolygonDepth, PiecesOfManyCornersOnASmallSpot) {
  for (const int count : {1, 2, 3})
    for (const int sides : {5, 9, 14}) {
      SCOPED_TRACE(std::to_string(count) + " pits of " + std::to_string(sides) + " sides");
      const Pits pits(count, sides, 1e-3);
      const auto found = dem_gpu::integrate_depth<PolygonDepth>(square(), pits.field(), {0, 0, 1}, LinearProfile{});
      EXPECT_FALSE(found.is_truncated);
      EXPECT_NEAR(found.area, 4, 1e-12 + kSingle.integral);
      const GridSums expected(pits);
      EXPECT_NEAR(found.depth, expected.depth, 2e-6 + kSingle.integral);
      EXPECT_LE(norm(found.central_moment() - expected.moment), 2e-6 + kSingle.integral);
    }
}

}  // namespace
