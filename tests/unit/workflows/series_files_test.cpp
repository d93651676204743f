// SPDX-License-Identifier: Apache-2.0
#include "workflows/series_files.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "workflows/atomic_file.h"

namespace workflows {
namespace {

class SeriesFiles : public testing::Test {
 protected:
  test_support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "series.csv";

  std::string goes_on(double keep_until) {
    SeriesFile series(file_, "time[s],x", keep_until);
    series.append("9,9");
    series.flush();
    return read_whole(file_).value();
  }
};

TEST_F(SeriesFiles, KeepsRowsUpToTheCheckpoint) {
  write_whole(file_, "time[s],x\n0,a\n0.1,b\n0.1,c\n0.2,d\n");
  EXPECT_EQ(goes_on(0.1), "time[s],x\n0,a\n0.1,b\n0.1,c\n9,9\n");
}

TEST_F(SeriesFiles, KeepsARowWhoseTimeWasRoundedUp) {
  write_whole(file_, "time[s],x\n0.666666666667,a\n0.67,b\n");
  EXPECT_EQ(goes_on(2.0 / 3), "time[s],x\n0.666666666667,a\n9,9\n");
}

TEST_F(SeriesFiles, DropsARowCutShort) {
  write_whole(file_, "time[s],x\n0,a\n0.");
  EXPECT_EQ(goes_on(1), "time[s],x\n0,a\n9,9\n");
}

TEST_F(SeriesFiles, StartsNewWithoutCheckpointOrFile) {
  EXPECT_EQ(goes_on(1), "time[s],x\n9,9\n");
  EXPECT_EQ(goes_on(-1), "time[s],x\n9,9\n");
}

}  // namespace
}  // namespace workflows
