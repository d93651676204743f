// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/narrow_phase/surface_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;
using dem_gpu::FrameChange;
using dem_gpu::kLanes;
using dem_gpu::LocalReal;
using dem_gpu::LocalVec3;
using dem_gpu::Polygon;
using dem_gpu::SurfaceTriangles;

Polygon regular_polygon(int corners, Real height) {
  LocalVec3 points[kLanes];
  LocalReal x[kLanes], y[kLanes], z[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const Real angle = 2 * std::numbers::pi * (i < corners ? i : 0) / corners;
    points[i] = dem_gpu::rounded(Vec3{std::cos(angle), std::sin(angle), height});
    x[i] = points[i].x, y[i] = points[i].y, z[i] = points[i].z;
  }
  return {dem_gpu::load_points(x, y, z), corners};
}
Real area_of(int corners) { return corners * std::sin(2 * std::numbers::pi / corners) / 2; }

struct Areas {
  Vec3 all, outer;
  Real unsigned_sum = 0;
};
Areas areas_of(const SurfaceTriangles& triangles) {
  Areas sums;
  for (int block = 0; block < triangles.block_count(); ++block)
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto corner = [&](int c) -> Vec3 { return point_at(triangles.corners(c, block), lane); };
      const Vec3 area = 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0));
      sums.all += area;
      sums.outer += triangles.outer(block)[lane] * area;
      sums.unsigned_sum += norm(area);
    }
  return sums;
}

TEST(SurfaceTriangles, HoldTheAreaOfTheirPolygons) {
  SurfaceTriangles triangles;
  EXPECT_TRUE(triangles.is_empty());
  Real all = 0, outer = 0;
  int count = 0;
  for (int corners = 1; corners <= kLanes; ++corners) {
    const bool is_outer = corners % 2 != 0;
    EXPECT_TRUE(triangles.add(regular_polygon(corners, corners), is_outer));
    EXPECT_EQ(triangles.is_empty(), corners < 3);
    if (corners < 3) continue;
    count += corners - 2;
    all += area_of(corners);
    outer += is_outer ? area_of(corners) : 0;
    SurfaceTriangles filled = triangles;
    filled.fill_up();
    EXPECT_EQ(filled.block_count(), (count + kLanes - 1) / kLanes);
    const Areas areas = areas_of(filled);
    EXPECT_NEAR(areas.all.z, all, 1e-14 + kSingle.integral);
    EXPECT_NEAR(areas.unsigned_sum, all, 1e-14 + kSingle.integral);
    EXPECT_NEAR(areas.outer.z, outer, 1e-14 + kSingle.integral);
  }
  EXPECT_EQ(triangles.point(2).z, 3);
  const FrameChange change{rotation_matrix(edge_down()), {1, 2, 3}, 2};
  SurfaceTriangles moved = triangles;
  moved.fill_up();
  moved.move(change);
  EXPECT_LE(norm(areas_of(moved).all - 4 * all * change.direction({0, 0, 1})), 1e-13 + 100 * kSingle.integral);
  EXPECT_LE(norm(Vec3(moved.point(1)) - change.point(triangles.point(1))), 1e-14 + 10 * kSingle.position);
  triangles.clear();
  EXPECT_TRUE(triangles.is_empty());
}

TEST(SurfaceTriangles, AreFull) {
  for (const int corners : {3, 5, 8}) {
    SurfaceTriangles triangles;
    const int room = SurfaceTriangles::kMost / (corners - 2);
    for (int i = 0; i < room; ++i) EXPECT_TRUE(triangles.add(regular_polygon(corners, 0), true));
    EXPECT_FALSE(triangles.add(regular_polygon(kLanes, 0), true));
    EXPECT_EQ(triangles.add(regular_polygon(2, 0), true), true) << "an edge has no area";
    triangles.fill_up();
    EXPECT_NEAR(areas_of(triangles).all.z, room * area_of(corners), 1e-12 + 100 * kSingle.integral);
  }
}

}  // namespace
