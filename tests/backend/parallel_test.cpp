// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/core/parallel.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace {

using dem_gpu::DeviceVector;

struct RowOfItem {
  const int* row;
  TALUS_HD int operator()(int item) const { return row[item]; }
};

TEST(Parallel, ItemsStandInTheirRowsAscending) {
  std::mt19937 random(1);
  for (const int row_count : {1, 2, 7, 1000})
    for (const int item_count : {0, 1, 5, 3000}) {
      std::vector<int> row_of(static_cast<std::size_t>(item_count));
      // Of many rows some stay empty, also at either end.
      for (int& row : row_of) {
        row = static_cast<int>(random() % static_cast<unsigned>(row_count));
        if (row_count == 1000) row = 100 + row / 2;
      }
      DeviceVector<int> on_device, first(3, -1);
      dem_gpu::assign(on_device, row_of);
      DeviceVector<std::int64_t> entries(5, -1);
      dem_gpu::sort_into_rows(item_count, row_count, RowOfItem{dem_gpu::pointer(on_device)}, first, entries);

      std::vector<int> expected_first{0};
      std::vector<std::int64_t> expected;
      for (int row = 0; row < row_count; ++row) {
        for (int item = 0; item < item_count; ++item)
          if (row_of[static_cast<std::size_t>(item)] == row) expected.push_back(dem_gpu::row_entry(row, item));
        expected_first.push_back(static_cast<int>(expected.size()));
      }
      EXPECT_EQ(dem_gpu::to_host(first), expected_first) << row_count << " rows of " << item_count;
      EXPECT_EQ(dem_gpu::to_host(entries), expected) << row_count << " rows of " << item_count;
    }
}

}  // namespace
