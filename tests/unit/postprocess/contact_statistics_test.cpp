// SPDX-License-Identifier: Apache-2.0
#include "postprocess/contact_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "catalog/input_error.h"

namespace postprocess {
namespace {

/// Four spheres of radius 1; body 3 is half as large, body 2 has left; one wall.
dem_gpu::RunGeometry four_spheres() {
  dem_gpu::RunGeometry geometry;
  geometry.shapes = {{"ball", 1, {}, 4 * std::numbers::pi / 3}};
  geometry.materials = {"steel"};
  geometry.material_density = {7850};
  geometry.body_shape = {0, 0, 0, 0};
  geometry.body_material = {0, 0, 0, 0};
  geometry.body_scale = {1, 1, 1, 0.5};
  geometry.body_mass = {1, 1, 1, 0.125};
  geometry.walls.resize(1);
  return geometry;
}

dem_gpu::Snapshot with_contacts(std::vector<dem_gpu::SnapshotContact> contacts) {
  dem_gpu::Snapshot snapshot;
  snapshot.active = {1, 1, 0, 1};
  snapshot.position.resize(4);
  snapshot.orientation.resize(4);
  snapshot.velocity.resize(4);
  snapshot.angular_velocity.resize(4);
  snapshot.wall_translation.resize(1);
  snapshot.wall_rotation.resize(1);
  snapshot.wall_present = {1};
  snapshot.contacts = std::move(contacts);
  return snapshot;
}

TEST(Spread, InterpolatesBetweenOrderStatistics) {
  std::vector<double> sample;
  for (int i = 100; i >= 0; --i) sample.push_back(i);
  const Spread s = spread(sample);
  EXPECT_DOUBLE_EQ(s.mean, 50);
  EXPECT_DOUBLE_EQ(s.median, 50);
  EXPECT_DOUBLE_EQ(s.percentile_90, 90);
  EXPECT_DOUBLE_EQ(s.percentile_99, 99);
  EXPECT_DOUBLE_EQ(s.largest, 100);
  EXPECT_EQ(spread({}).mean, 0);
  EXPECT_DOUBLE_EQ(spread({1, 2}).median, 1.5);
}

TEST(ContactStatistics, CountsNeighboursOnceHoweverManyPartsTouch) {
  const auto s = contact_statistics(
      four_spheres(),
      with_contacts({{0, 1, {}, {3, 0, 4}, 0.02}, {1, 0, {}, {0, 0, 1}, 0.01}, {0, -1, {}, {0, 2, 0}, 0.04}}));
  EXPECT_EQ(s.active_bodies, 3);
  EXPECT_EQ(s.body_contacts, 2);
  EXPECT_EQ(s.wall_contacts, 1);
  EXPECT_DOUBLE_EQ(s.coordination_number, 2.0 / 3);
  EXPECT_EQ(s.touching_nothing, 1);
  EXPECT_DOUBLE_EQ(s.force.mean, (5.0 + 1 + 2) / 3);
  EXPECT_DOUBLE_EQ(s.force.largest, 5);
}

TEST(ContactStatistics, OverlapIsRelativeToTheSmallerBody) {
  const auto s = contact_statistics(four_spheres(), with_contacts({{0, 3, {}, {}, 0.01}}));
  EXPECT_NEAR(s.overlap.largest, 0.01 / (2 * 0.5), 1e-15);
}

TEST(ContactStatistics, RefusesASnapshotOfAnotherRun) {
  dem_gpu::RunGeometry geometry = four_spheres();
  geometry.body_shape.push_back(0);
  EXPECT_THROW(contact_statistics(geometry, with_contacts({})), catalog::InputError);
}

}  // namespace
}  // namespace postprocess
