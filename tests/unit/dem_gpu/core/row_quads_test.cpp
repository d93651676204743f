// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/core/row_quads.h"

#include <gtest/gtest.h>

#include <vector>

#include "dem_gpu/core/row_blocks.h"

using dem_gpu::kRealLanes;
using dem_gpu::Real;
using dem_gpu::RealLanes;
using dem_gpu::RowLanes;
using dem_gpu::Vec3;

namespace {

struct TwoQuads {
  Vec3 first;
  Real of_first = 0;
  Vec3 second;
  Real of_second = 0;
};

std::vector<TwoQuads> numbered_rows(int count) {
  std::vector<TwoQuads> rows;
  for (int i = 0; i < count; ++i) {
    const Real n = 100 * i;
    rows.push_back({{n, n + 1, n + 2}, n + 3, {n + 4, n + 5, n + 6}, n + 7});
  }
  return rows;
}

/// Rows here and there, in no order.
RowLanes scattered_rows(int count) {
  RowLanes lanes;
  for (int i = 0; i < kRealLanes; ++i) lanes.row[i] = (7 * i + 5) % count;
  return lanes;
}

constexpr int kRows = 23;

TEST(RowQuads, AreGatheredComponentByComponent) {
  const std::vector<TwoQuads> rows = numbered_rows(kRows);
  const RowLanes lanes = scattered_rows(kRows);
  const auto first = gather_quad(rows.data(), lanes, 0), second = gather_quad(rows.data(), lanes, 1);
  for (int i = 0; i < kRealLanes; ++i) {
    const TwoQuads& row = rows[static_cast<std::size_t>(lanes[i])];
    EXPECT_EQ(dem_gpu::lane(first.vector, i), row.first) << i;
    EXPECT_EQ(dem_gpu::lane(first.number, i), row.of_first) << i;
    EXPECT_EQ(dem_gpu::lane(second.vector, i), row.second) << i;
    EXPECT_EQ(dem_gpu::lane(second.number, i), row.of_second) << i;
  }
}

TEST(RowQuads, AreScatteredWhereTheyBelongAndNowhereElse) {
  const std::vector<TwoQuads> rows = numbered_rows(kRows);
  const RowLanes lanes = scattered_rows(kRows);
  std::vector<TwoQuads> copies(kRows);
  scatter_quad(copies.data(), lanes, 1, gather_quad(rows.data(), lanes, 1));
  std::vector<TwoQuads> expected(kRows);
  for (int i = 0; i < kRealLanes; ++i) {
    const auto row = static_cast<std::size_t>(lanes[i]);
    expected[row].second = rows[row].second;
    expected[row].of_second = rows[row].of_second;
  }
  for (std::size_t i = 0; i < kRows; ++i) {
    EXPECT_EQ(copies[i].first, expected[i].first) << i;
    EXPECT_EQ(copies[i].of_first, expected[i].of_first) << i;
    EXPECT_EQ(copies[i].second, expected[i].second) << i;
    EXPECT_EQ(copies[i].of_second, expected[i].of_second) << i;
  }
}

TEST(RowQuads, SumInOrderWithTheirSigns) {
  const std::vector<TwoQuads> rows = numbered_rows(3);
  dem_gpu::QuadSum sum(Vec3{1, 2, 3});
  sum.add(&rows[1].first.x, 1);
  sum.add(&rows[2].second.x, -1);
  EXPECT_EQ(sum.vector(), (Vec3{1 + 100 - 204, 2 + 101 - 205, 3 + 102 - 206}));
}

TEST(RowBlocks, TurnRowsIntoRegistersAndBack) {
  std::vector<Vec3> vectors(kRealLanes);
  std::vector<dem_gpu::Quaternion> quaternions(kRealLanes);
  for (int i = 0; i < kRealLanes; ++i) {
    const Real n = 10 * i;
    vectors[static_cast<std::size_t>(i)] = {n, n + 1, n + 2};
    quaternions[static_cast<std::size_t>(i)] = {n, n + 1, n + 2, n + 3};
  }
  const auto turned = dem_gpu::load_rows(vectors.data());
  const auto turned_quaternions = dem_gpu::load_rows(quaternions.data());
  for (int i = 0; i < kRealLanes; ++i) {
    EXPECT_EQ(dem_gpu::lane(turned, i), vectors[static_cast<std::size_t>(i)]) << i;
    EXPECT_EQ(dem_gpu::lane(turned_quaternions.w, i), quaternions[static_cast<std::size_t>(i)].w) << i;
    EXPECT_EQ(dem_gpu::lane(turned_quaternions.z, i), quaternions[static_cast<std::size_t>(i)].z) << i;
  }
  std::vector<Vec3> back(kRealLanes);
  store_rows(turned, back.data());
  EXPECT_EQ(back, vectors);
  std::vector<dem_gpu::Quaternion> quaternions_back(kRealLanes);
  store_rows(turned_quaternions, quaternions_back.data());
  EXPECT_EQ(quaternions_back, quaternions);
}

}  // namespace
