// SPDX-License-Identifier: Apache-2.0
#include "workflows/series_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <sstream>

#include "dem_gpu/simulation.h"
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

TEST_F(SeriesFiles, APipeOrADeviceIsNotReplaced) {
  std::filesystem::remove(file_);
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THROW(write_whole(file_, "text"), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_fifo(file_));
}

TEST_F(SeriesFiles, DropsARowCutShort) {
  write_whole(file_, "time[s],x\n0,a\n0.");
  EXPECT_EQ(goes_on(1), "time[s],x\n0,a\n9,9\n");
}

TEST_F(SeriesFiles, StartsNewWithoutCheckpointOrFile) {
  EXPECT_EQ(goes_on(1), "time[s],x\n9,9\n");
  EXPECT_EQ(goes_on(-1), "time[s],x\n9,9\n");
}

TEST_F(SeriesFiles, SaysWhatIsMissingToGoOn) {
  const auto gap = [&](const char* text, double due) {
    if (text)
      write_whole(file_, text);
    else
      std::filesystem::remove(file_);
    return SeriesFile(file_, "time[s],x", 1).gap(due);
  };
  EXPECT_EQ(gap("time[s],x\n0,a\n0,b\n0.666666666667,a\n0.666666666667,b\n", 2.0 / 3), "");
  EXPECT_NE(gap("time[s],x\n0,a\n0.1,a\n", 0.2).find("ends at 0.1 s; it goes on without its rows up to 0.2 s"),
            std::string::npos);
  EXPECT_NE(gap("time[s],x\n0,a\n0,b\n0.2,a\n0.2", 0.2).find("some rows of its last time"), std::string::npos);
  EXPECT_NE(gap("time[s],x\n", 0.2).find("has no rows"), std::string::npos);
  EXPECT_NE(gap(nullptr, 0.2).find("was missing"), std::string::npos);
  EXPECT_NE(gap("time[s],y\n0,a\n", 0.2).find("another header"), std::string::npos);
  EXPECT_EQ(read_whole(file_.string() + ".old").value(), "time[s],y\n0,a\n") << "nothing is thrown away";
}

TEST_F(SeriesFiles, LoadsOfAGroupAreTheSumOfItsWalls) {
  // A ball at rest in the corner of a floor and a side that are one group; the lone plane beside them is in none.
  dem_gpu::Scene scene;
  scene.gravity = {-1, 0, -9.81};
  scene.materials = {{"glass", 2500}};
  scene.contact = {{{0.5, 0}}};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.sphere_law = dem_gpu::LinearSpring{1e4};
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
  scene.bodies.resize(1);
  scene.bodies[0].position = {0.00999, 0, 0.00995};
  scene.walls.resize(3);
  const dem_gpu::Vec3 normals[] = {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}};
  for (std::size_t w = 0; w < 3; ++w) {
    scene.walls[w].name = std::string("w") + std::to_string(w);
    scene.walls[w].geometry = dem_gpu::Plane{w == 2 ? dem_gpu::Vec3{1, 0, 0} : dem_gpu::Vec3{}, normals[w]};
    if (w < 2) scene.walls[w].group = "corner";
  }
  dem_gpu::Simulation simulation(scene);
  RunSeries series(folder_.path(), scene, -1);
  simulation.advance(2000);
  simulation.take_wall_loads();
  simulation.advance(2000);
  series.append(simulation, simulation.ledger(), 0);
  std::istringstream rows(read_whole(folder_.path() / "groups.csv").value());
  std::string header, group, none;
  std::getline(rows, header);
  ASSERT_TRUE(std::getline(rows, group));
  EXPECT_FALSE(std::getline(rows, none)) << "one group, one row";
  std::vector<std::string> cells;
  std::istringstream row(group);
  for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
  ASSERT_GE(cells.size(), 5u) << header;
  EXPECT_EQ(cells[1], "corner");
  // The mean load carries the ball's weight once it is at rest: to 1e-3 after some hundred damped oscillations.
  const double mass = 2500 * 4.18879e-6;
  EXPECT_NEAR(std::stod(cells[2]), -mass, 1e-3 * mass);
  EXPECT_NEAR(std::stod(cells[4]), -9.81 * mass, 1e-3 * 9.81 * mass);
}

}  // namespace
}  // namespace workflows
