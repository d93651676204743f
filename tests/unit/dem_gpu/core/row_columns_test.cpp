// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/core/row_columns.h"

#include <gtest/gtest.h>

#include <vector>

#include "dem_gpu/core/row_field.h"

using dem_gpu::gather;
using dem_gpu::kRealLanes;
using dem_gpu::Quaternion;
using dem_gpu::Real;
using dem_gpu::RowLanes;
using dem_gpu::Vec3;

namespace {

struct Row {
  Real number = 0;
  Vec3 vector;
};

constexpr int kRows = kRealLanes;

/// The last row of all among them, and the first one twice where there are several lanes.
RowLanes some_rows() {
  RowLanes rows;
  for (int i = 0; i < kRealLanes; ++i) rows.row[i] = (kRows - 1 + i * (kRows - 1)) % kRows;
  rows.row[kRealLanes - 1] = rows[0];
  return rows;
}

TEST(RowColumns, AreGatheredToTheLastEntry) {
  std::vector<Real> numbers;
  std::vector<Vec3> vectors;
  std::vector<Quaternion> quaternions;
  std::vector<Row> table;
  for (int i = 0; i < kRows; ++i) {
    const Real n = 10 * i;
    numbers.push_back(n);
    vectors.push_back({n + 1, n + 2, n + 3});
    quaternions.push_back({n + 4, n + 5, n + 6, n + 7});
    table.push_back({n, vectors.back()});
  }
  const RowLanes rows = some_rows();
  const auto number = gather(numbers.data(), rows);
  const auto vector = gather(vectors.data(), rows);
  const auto quaternion = gather(quaternions.data(), rows);
  const auto field = gather(dem_gpu::RowField<&Row::vector>{table.data()}, rows);
  for (int i = 0; i < kRealLanes; ++i) {
    const int row = rows[i];
    EXPECT_EQ(dem_gpu::lane(number, i), gather(numbers.data(), row));
    EXPECT_EQ(dem_gpu::lane(vector, i), gather(vectors.data(), row));
    EXPECT_EQ(dem_gpu::lane(field, i), gather(vectors.data(), row));
    const Quaternion lane{dem_gpu::lane(quaternion.w, i), dem_gpu::lane(quaternion.x, i),
                          dem_gpu::lane(quaternion.y, i), dem_gpu::lane(quaternion.z, i)};
    EXPECT_EQ(lane, gather(quaternions.data(), row));
  }
}

TEST(RowColumns, AreScatteredWhereTheyBelongAndNowhereElse) {
  std::vector<Row> table(kRows + 1);
  std::vector<Vec3> vectors(kRows + 1);
  std::vector<Real> numbers(kRows + 1);
  std::vector<Vec3> values;
  for (int i = 0; i < kRows; ++i) values.push_back({i + Real(1), i + Real(2), i + Real(3)});
  const RowLanes rows = some_rows();
  const auto lanes = gather(values.data(), rows);
  scatter(vectors.data(), rows, lanes);
  scatter(dem_gpu::RowField<&Row::vector>{table.data()}, rows, lanes);
  scatter(numbers.data(), rows, lanes.x);
  std::vector<Vec3> expected(kRows + 1);
  for (int i = 0; i < kRealLanes; ++i) expected[rows[i]] = values[rows[i]];
  for (int i = 0; i <= kRows; ++i) {
    EXPECT_EQ(vectors[i], expected[i]) << i;
    EXPECT_EQ(table[i].vector, expected[i]) << i;
    EXPECT_EQ(table[i].number, 0) << i;
    EXPECT_EQ(numbers[i], expected[i].x) << i;
  }
}

}  // namespace
