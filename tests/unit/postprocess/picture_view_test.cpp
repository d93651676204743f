// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "postprocess/pictures.h"
#include "tests/unit/postprocess/synthetic_run.h"

namespace postprocess {
namespace {

using dem_gpu::Vec3;

/// Largest |x| and |y| of the points on the picture, 1 at its edges.
std::pair<double, double> projected_reach(const PictureView& view, const std::vector<Vec3>& points, double aspect) {
  const Vec3 backward = dem_gpu::unit_or(view.eye - view.focus, {0, 0, 1});
  const Vec3 right = cross(view.up, backward);
  const double tangent = std::tan(view.view_angle / 360 * std::numbers::pi);
  double x = 0, y = 0;
  for (const Vec3& point : points) {
    const Vec3 p = point - view.eye;
    const double depth = -dot(p, backward);
    EXPECT_GT(depth, 0);
    x = std::max(x, std::abs(dot(p, right)) / depth / tangent / aspect);
    y = std::max(y, std::abs(dot(p, view.up)) / depth / tangent);
  }
  return {x, y};
}

TEST(PictureView, LooksAlongADrumsAxis) {
  const auto geometry = test_support::mill_geometry();
  const auto snapshot = test_support::mill_snapshot(geometry, 1);
  const PictureView view = picture_view(geometry, {snapshot}, {0, 0, 1});
  EXPECT_EQ(view.kind, SceneKind::drum);
  const Vec3 along = dem_gpu::unit_or(view.eye - view.focus, {});
  EXPECT_GT(std::abs(along.y), std::cos(15 * std::numbers::pi / 180));
  const auto [x, y] = projected_reach(view, snapshot.position, 4.0 / 3);
  EXPECT_LT(x, 0.8);
  EXPECT_LT(y, 0.95);
}

TEST(PictureView, LooksAtAHopperFromTheSideAndHoldsItAll) {
  const auto geometry = test_support::hopper_geometry();
  const auto before = test_support::hopper_snapshot(geometry, 0), after = test_support::hopper_snapshot(geometry, 3);
  const PictureView view = picture_view(geometry, {before, after}, {0, 0, 1});
  EXPECT_EQ(view.kind, SceneKind::hopper);
  EXPECT_LT(std::abs(dem_gpu::unit_or(view.eye - view.focus, {}).z), 0.3);
  std::vector<Vec3> points;
  for (const auto* snapshot : {&before, &after})
    for (std::size_t b = 0; b < snapshot->active.size(); ++b)
      if (snapshot->active[b]) points.push_back(snapshot->position[b]);
  for (int k = 0; k < 24; ++k)
    for (const double z : {0.3, 0.7})
      points.push_back({0.2 * std::cos(k * std::numbers::pi / 12), 0.2 * std::sin(k * std::numbers::pi / 12), z});
  const auto [x, y] = projected_reach(view, points, 4.0 / 3);
  EXPECT_LE(x, 0.81);
  EXPECT_LE(y, 0.96);
  EXPECT_GT(std::max(x / 0.8, y / 0.95), 0.9);  // and fills the picture
  EXPECT_GE(view.fastest, 0.1);
}

TEST(PictureView, TurnsWithGravity) {
  auto geometry = test_support::hopper_geometry();
  const auto snapshot = test_support::hopper_snapshot(geometry, 0);
  EXPECT_EQ(picture_view(geometry, {snapshot}, {1, 0, 0}).kind, SceneKind::drum);
  geometry.walls.clear();
  auto bare = snapshot;
  bare.wall_present.clear();
  bare.wall_rotation.clear();
  bare.wall_translation.clear();
  EXPECT_EQ(picture_view(geometry, {bare}, {0, 1, 0}).kind, SceneKind::open);
  EXPECT_TRUE(std::isfinite(norm(picture_view(geometry, {bare}, {0, 1, 0}).eye)));
}

}  // namespace
}  // namespace postprocess
