// SPDX-License-Identifier: Apache-2.0
// Cuts of polygons: of the lanes' polygon against the plain one of Sutherland and Hodgman, and both against areas
// known.
#include "dem_gpu/narrow_phase/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "dem_gpu/narrow_phase/face_polygon.h"
#include "dem_gpu/narrow_phase/part_overlap.h"
#include "tests/support/precision.h"

namespace {

using dem_gpu::CutPieces;
using dem_gpu::FacePolygon;
using dem_gpu::HalfSpace;
using dem_gpu::kLanes;
using dem_gpu::LaneOrder;
using dem_gpu::LocalHalfSpace;
using dem_gpu::LocalReal;
using dem_gpu::LocalVec3;
using dem_gpu::Polygon;
using dem_gpu::Real;
using dem_gpu::rounded;
using dem_gpu::Vec3;
using test_support::kSingle;

Polygon lane_polygon(const std::vector<Vec3>& corners) {
  LocalReal x[kLanes], y[kLanes], z[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const LocalVec3 corner = rounded(corners[i < static_cast<int>(corners.size()) ? i : 0]);
    x[i] = corner.x, y[i] = corner.y, z[i] = corner.z;
  }
  return {dem_gpu::load_points(x, y, z), static_cast<int>(corners.size())};
}
FacePolygon face_polygon(const std::vector<Vec3>& corners) {
  FacePolygon polygon;
  for (const Vec3& corner : corners) append(polygon, rounded(corner));
  return polygon;
}

Vec3 corner_of(const Polygon& polygon, int i) { return polygon.corner(i); }
Vec3 corner_of(const FacePolygon& polygon, int i) { return polygon.corner[i]; }

/// Vector area.
template <class SomePolygon>
Vec3 area(const SomePolygon& polygon) {
  Vec3 sum;
  const Vec3 first = polygon.count > 0 ? corner_of(polygon, 0) : Vec3{};
  for (int c = 2; c < polygon.count; ++c)
    sum += 0.5 * cross(corner_of(polygon, c - 1) - first, corner_of(polygon, c) - first);
  return sum;
}

LocalHalfSpace half_space(const Vec3& normal, Real offset) { return rounded(HalfSpace{normal, offset}); }

Polygon cut_by(const Polygon& polygon, const LocalHalfSpace& plane) {
  const dem_gpu::Lanes depths = depths_below(plane, polygon.corners);
  return cut(polygon, depths, cut_order(polygon, depths));
}

const std::vector<Vec3> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::vector<Vec3> regular_polygon(int corners) {
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) {
    const Real angle = 2 * std::numbers::pi * i / corners;
    points.push_back({std::cos(angle), std::sin(angle), 0.5});
  }
  return points;
}

TEST(PolygonCut, KeepsTheAreaInside) {
  const Polygon square = lane_polygon(kSquare);
  EXPECT_NEAR(area(cut_by(square, half_space({1, 0, 0}, 0.3))).z, 0.3, 1e-15 + kSingle.position);
  const Polygon half = cut_by(square, half_space({2, 2, 0}, 2));  // the normal need not be a unit vector
  EXPECT_NEAR(area(half).z, 0.5, 1e-15);
  EXPECT_NEAR(area(cut_by(square, half_space({1, 0, 0}, 1))).z, 1, 1e-15) << "a plane through an edge takes nothing";
  EXPECT_EQ(cut_by(square, half_space({1, 0, 0}, 2)).count, 4);
  EXPECT_EQ(area(cut_by(square, half_space({1, 0, 0}, 0))).z, 0) << "only an edge is left";
  EXPECT_EQ(cut_by(square, half_space({1, 0, 0}, -1)).count, 0);
}

TEST(PolygonCut, IsThatOfSutherlandAndHodgman) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  int cuts = 0;
  for (int corners = 3; corners <= kLanes; ++corners)
    for (int trial = 0; trial < 500; ++trial) {
      Polygon lanes = lane_polygon(regular_polygon(corners));
      FacePolygon plain = face_polygon(regular_polygon(corners)), next;
      for (int k = 0; k < 4; ++k) {
        const LocalHalfSpace plane = half_space({uniform(random), uniform(random), uniform(random)}, uniform(random));
        if (outgrows(cut_order(lanes, depths_below(plane, lanes.corners)))) continue;
        clip(plain, plane, next);
        plain = next;
        lanes = cut_by(lanes, plane);
        ASSERT_EQ(lanes.count, plain.count);
        if (lanes.count == 0) break;
        ASSERT_NEAR(norm(area(lanes) - area(plain)), 0, 1e-14 + kSingle.position);
        for (int i = lanes.count; i < kLanes; ++i) ASSERT_EQ(lanes.corner(i), lanes.corner(0)) << "lanes beyond";
        ++cuts;
      }
    }
  EXPECT_GT(cuts, 2000);
}

TEST(PolygonCut, OfFlushCornersTheLongestRowStays) {
  // Corners a rounding error above and below the plane by turns: any of them may stay, none may be lost sight of.
  std::vector<Vec3> corners = regular_polygon(8);
  for (int i = 0; i < 8; ++i) corners[i].z = i % 2 == 0 ? 1e-17 : -1e-17;
  corners[1].z = corners[2].z = corners[3].z = -1e-17;
  const Polygon piece = cut_by(lane_polygon(corners), half_space({0, 0, 1}, 0));
  EXPECT_EQ(piece.count, 5) << "three corners in a row and the two points beside them";
  EXPECT_FALSE(piece.is_truncated);
  for (int i = 0; i < piece.count; ++i) EXPECT_NEAR(norm(corner_of(piece, i)), 1, 0.1);
}

TEST(PolygonCut, SaysWhenACornerDoesNotFit) {
  const Polygon octagon = lane_polygon(regular_polygon(8));
  const LocalHalfSpace plane = half_space({1, 0, 0}, 0.9);  // takes one corner off, adds two
  EXPECT_TRUE(outgrows(cut_order(octagon, depths_below(plane, octagon.corners))));
  EXPECT_TRUE(cut_by(octagon, plane).is_truncated);
}

TEST(CutPieces, APieceThatOutgrowsItsLanesBecomesTwo) {
  // An octagon whose eight corners are all cut off: sixteen corners.
  CutPieces pieces;
  ASSERT_TRUE(pieces.add(lane_polygon(regular_polygon(8)), 3));
  FacePolygon plain = face_polygon(regular_polygon(8)), next;
  for (int i = 0; i < 8; ++i) {
    const Real angle = 2 * std::numbers::pi * i / 8;
    const LocalHalfSpace plane = half_space({std::cos(angle), std::sin(angle), 0}, 0.97);
    ASSERT_EQ(pieces.cut_all(plane), CutPieces::Cut::some);
    const LocalHalfSpace beyond = half_space({std::cos(angle), std::sin(angle), 0}, 0.97 + 1e-6);
    EXPECT_EQ(pieces.cut_all(beyond), CutPieces::Cut::none);
    clip(plain, plane, next);
    plain = next;
  }
  ASSERT_EQ(plain.count, 16);
  EXPECT_GT(pieces.count(), 1);
  Vec3 sum;
  for (int i = 0; i < pieces.count(); ++i) {
    EXPECT_EQ(pieces.face(i), 3);
    EXPECT_FALSE(pieces.piece(i).is_truncated);
    sum += area(pieces.piece(i));
  }
  EXPECT_NEAR(norm(sum - area(plain)), 0, 1e-14 + kSingle.position);
}

TEST(CutPieces, RefusesWhatItHasNoRoomFor) {
  CutPieces pieces;
  int taken = 0;
  while (taken < 1000 && pieces.add(lane_polygon(kSquare), 0)) ++taken;
  EXPECT_EQ(taken, pieces.count());
  EXPECT_LT(taken, 1000);
}

TEST(HalfOf, TwoHalvesMakeThePolygon) {
  for (int corners = 4; corners <= kLanes; ++corners) {
    const Polygon polygon = lane_polygon(regular_polygon(corners));
    const Polygon first = half_of(polygon, false), second = half_of(polygon, true);
    EXPECT_EQ(first.count + second.count, corners + 2) << "the diagonal's corners are in both";
    EXPECT_NEAR(norm(area(first) + area(second) - area(polygon)), 0, 1e-15 + kSingle.position);
    EXPECT_GT(area(first).z, 0);
    EXPECT_GT(area(second).z, 0);
  }
}

TEST(FacePolygon, KeepsTheAreaInside) {
  const FacePolygon square = face_polygon(kSquare);
  FacePolygon piece;
  clip(square, half_space({1, 0, 0}, 0.3), piece);
  EXPECT_NEAR(area(piece).z, 0.3, 1e-15 + kSingle.position);
  clip(square, half_space({2, 2, 0}, 2), piece);
  EXPECT_NEAR(area(piece).z, 0.5, 1e-15);
  EXPECT_EQ(piece.count, 3);
  clip(square, half_space({1, 0, 0}, 1), piece);
  EXPECT_NEAR(area(piece).z, 1, 1e-15) << "a plane through an edge takes nothing away";
  EXPECT_EQ(piece.count, 4);
  clip(square, half_space({1, 0, 0}, 0), piece);
  EXPECT_EQ(piece.count, 0) << "only an edge is left";
  clip(square, half_space({1, 0, 0}, -1), piece);
  EXPECT_EQ(piece.count, 0);
}

TEST(FacePolygon, SaysWhenACornerDoesNotFit) {
  FacePolygon polygon;
  for (int i = 0; i <= dem_gpu::kMaxPolygonCorners; ++i) append(polygon, {static_cast<LocalReal>(i), 0, 0});
  EXPECT_TRUE(polygon.is_truncated);
  EXPECT_EQ(polygon.count, dem_gpu::kMaxPolygonCorners);
}

}  // namespace
