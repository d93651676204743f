// SPDX-License-Identifier: Apache-2.0
#include "postprocess/time_series.h"

#include <gtest/gtest.h>

#include "catalog/input_error.h"
#include "tests/support/temporary_folder.h"

namespace postprocess {
namespace {

using test_support::TemporaryFolder;
using test_support::write_bytes;

class TimeSeriesFile : public testing::Test {
 protected:
  TimeSeries read(const std::string& text) {
    write_bytes(folder_ / "table.csv", text);
    return read_time_series(folder_ / "table.csv");
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const catalog::InputError& error) {
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

TEST_F(TimeSeriesFile, SplitsHeadersAndReadsNumbersExactly) {
  const TimeSeries series = read("time[s],power[W],torque_x[N m]\r\n0,1e3,-0.1\r\n0.5,2.5,3\r\n");
  ASSERT_EQ(series.columns.size(), 3u);
  EXPECT_EQ(series.columns[2].name, "torque_x");
  EXPECT_EQ(series.columns[2].unit, "N m");
  EXPECT_EQ(series.at("power"), (std::vector<double>{1000, 2.5}));
  EXPECT_EQ(series.at("torque_x")[0], -0.1);
  EXPECT_EQ(series.row_count(), 2u);
  EXPECT_FALSE(series.has("kinetic"));
}

TEST_F(TimeSeriesFile, LeavesOutALineThatIsStillBeingWritten) {
  const TimeSeries series = read("time[s],power[W]\n0,1\n1,2\n2,3.4");
  EXPECT_EQ(series.at("power"), (std::vector<double>{1, 2}));
}

TEST_F(TimeSeriesFile, HeaderAloneIsATableWithoutRows) {
  EXPECT_EQ(read("time[s],power[W]\n").row_count(), 0u);
  EXPECT_TRUE(read("time[s],power[W]\n").has("power"));
}

TEST_F(TimeSeriesFile, NamesTheLineThatIsWrong) {
  EXPECT_NE(refusal("time[s],power[W]\n0,1\n1\n").find("line 3: expected 2 fields, found 1"), std::string::npos);
  EXPECT_NE(refusal("time[s],power[W]\n0,one\n").find("line 2: column power"), std::string::npos);
  EXPECT_NE(refusal("time[s],power[W]\n0,nan\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusal("time[s],power[W]\n0,1x\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusal("time[s],power[W]\n1,0\n0,0\n").find("line 3: time goes back"), std::string::npos);
  EXPECT_NE(refusal("time[s],power\n").find("expected name[unit]"), std::string::npos);
  EXPECT_NE(refusal("power[W],time[s]\n").find("time[s] as the first column"), std::string::npos);
  EXPECT_NE(refusal("").find("empty"), std::string::npos);
  EXPECT_THROW(read_time_series(folder_ / "absent.csv"), catalog::InputError);
  EXPECT_THROW(read("time[s]\n0\n").at("power"), catalog::InputError);
}

TEST_F(TimeSeriesFile, GroupsRowsByATextColumn) {
  write_bytes(folder_ / "walls.csv",
              "time[s],wall,power[W]\n0,shell,1\n0,\"lifter, \"\"A\"\"\",2\n1,shell,3\n1,\"lifter, \"\"A\"\"\",4\n");
  const auto groups = read_grouped_series(folder_ / "walls.csv", "wall");
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups.at("shell").at("power"), (std::vector<double>{1, 3}));
  EXPECT_EQ(groups.at("lifter, \"A\"").at("power"), (std::vector<double>{2, 4}));
  EXPECT_THROW(read_grouped_series(folder_ / "walls.csv", "class"), catalog::InputError);
}

}  // namespace
}  // namespace postprocess
