// SPDX-License-Identifier: Apache-2.0
// The talus-post executable on made-up run folders: files, exit statuses, pictures.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cstdlib>
#include <set>

#include "tests/support/temporary_folder.h"
#include "tests/unit/postprocess/synthetic_run.h"

namespace {

namespace fs = std::filesystem;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using test_support::write_bytes;

struct Outcome {
  int status;
  std::string out;
  std::string err;
};

Outcome talus_post(const TemporaryFolder& folder, const std::string& arguments, const std::string& environment = "") {
  const std::string command = environment + " '" TALUS_POST "' " + arguments + " >'" + (folder / "out").string() +
                              "' 2>'" + (folder / "err").string() + "'";
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), read_bytes(folder / "out"), read_bytes(folder / "err")};
}

std::string quoted(const fs::path& path) { return std::string("'").append(path.string()).append("'"); }

TEST(TalusPost, WritesSeriesCurvesAndReport) {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  test_support::write_mill_run(run);
  const Outcome outcome = talus_post(folder, quoted(run) + " --no-pictures --every 2");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, (run / "report.html").string() + "\n");
  for (const char* name : {"bodies_000000.vtp", "walls_000002.vtp", "contacts_000004.vtp", "bodies.pvd", "walls.pvd",
                           "contacts.pvd", "power.svg", "energy.svg"})
    EXPECT_TRUE(fs::exists(run / "post" / name)) << name;
  EXPECT_FALSE(fs::exists(run / "post" / "bodies_000001.vtp"));
  EXPECT_NE(
      read_bytes(run / "post" / "bodies.pvd").find("timestep=\"3\" group=\"\" part=\"0\" file=\"bodies_000002.vtp\""),
      std::string::npos);
  EXPECT_NE(read_bytes(run / "report.html").find("left out by --no-pictures"), std::string::npos);
}

TEST(TalusPost, KeepsFilesThatAreNewerThanTheirSnapshot) {
  const TemporaryFolder folder;
  const fs::path run = folder / "run", kept = run / "post" / "bodies_000001.vtp";
  test_support::write_hopper_run(run);
  ASSERT_EQ(talus_post(folder, quoted(run) + " --no-pictures").status, 0);
  write_bytes(kept, "marked");
  ASSERT_EQ(talus_post(folder, quoted(run) + " --no-pictures").status, 0);
  EXPECT_EQ(read_bytes(kept), "marked");
  fs::last_write_time(run / "snapshots" / "snapshot_000001.h5", fs::last_write_time(kept) + std::chrono::seconds(5));
  ASSERT_EQ(talus_post(folder, quoted(run) + " --no-pictures").status, 0);
  EXPECT_NE(read_bytes(kept), "marked");
}

TEST(TalusPost, ExitStatusesAndOneLineErrors) {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  test_support::write_hopper_run(run);
  EXPECT_EQ(talus_post(folder, "--help").status, 0);
  EXPECT_NE(talus_post(folder, "--help").out.find("Example: talus post"), std::string::npos);
  EXPECT_EQ(talus_post(folder, "").status, 2);
  EXPECT_EQ(talus_post(folder, quoted(run) + " --nonsense").status, 2);
  EXPECT_EQ(talus_post(folder, quoted(run) + " --every 0").status, 2);
  EXPECT_EQ(talus_post(folder, quoted(folder / "absent")).status, 3);
  EXPECT_EQ(talus_post(folder, quoted(folder.path())).status, 3);

  const fs::path snapshot = run / "snapshots" / "snapshot_000002.h5";
  const std::string whole = read_bytes(snapshot);
  write_bytes(snapshot, whole.substr(0, whole.size() / 2));
  const Outcome truncated = talus_post(folder, quoted(run) + " --no-pictures");
  EXPECT_EQ(truncated.status, 3);
  EXPECT_NE(truncated.err.find("snapshot_000002.h5: truncated"), std::string::npos) << truncated.err;
  write_bytes(snapshot, whole);

  write_bytes(run / "time_series.csv", "time[s],power[W]\n0,1\n1\n");
  const Outcome table = talus_post(folder, quoted(run) + " --no-pictures");
  EXPECT_EQ(table.status, 3);
  EXPECT_NE(table.err.find("time_series.csv: line 3"), std::string::npos) << table.err;
  EXPECT_EQ(std::count(table.err.begin(), table.err.end(), '\n'), 1);
}

TEST(TalusPost, GoesOnWithoutADisplay) {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  test_support::write_hopper_run(run);
  const Outcome outcome = talus_post(folder, quoted(run) + " --report-only", "DISPLAY= PATH=/nonexistent");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("xvfb-run is not installed"), std::string::npos) << outcome.err;
  EXPECT_NE(read_bytes(run / "report.html").find("No pictures: no display"), std::string::npos);
  EXPECT_FALSE(fs::exists(run / "post" / "bodies.pvd"));
}

TEST(TalusPost, DrawsPicturesThatShowSomething) {
  if (std::system("command -v xvfb-run >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "xvfb-run is not installed, so pictures cannot be drawn here";
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  test_support::write_mill_run(run);
  for (int s : {1, 2, 3}) fs::remove(run / "snapshots" / ("snapshot_00000" + std::to_string(s) + ".h5"));
  const Outcome outcome = talus_post(folder, quoted(run) + " --report-only", "DISPLAY=");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((run / "post" / "picture_000004.png").c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  ASSERT_EQ(image->GetDimensions()[0], 1200);
  ASSERT_EQ(image->GetDimensions()[1], 900);
  std::set<int> colours;
  int reddish = 0;
  for (int y = 0; y < 900; y += 3)
    for (int x = 0; x < 1000; x += 3) {
      const auto* pixel = static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0));
      colours.insert(pixel[0] << 16 | pixel[1] << 8 | pixel[2]);
      reddish += pixel[0] > pixel[2] + 60 ? 1 : 0;
    }
  EXPECT_GT(colours.size(), 1000u);
  EXPECT_GT(reddish, 2000);  // the moving charge, more than 2 % of the picture
  EXPECT_NE(read_bytes(run / "report.html").find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
}

}  // namespace
