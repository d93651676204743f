// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of a large cloud. TALUS_LARGE_POINTS sets its points and has it digitised (`make large-cloud`: 50,000,000); by
// default 1,000,000 are only read.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <numbers>

#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/digitization.h"
#include "tests/support/temporary_folder.h"

namespace shape_pipeline {
namespace {

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

constexpr std::array<double, 3> kAxes{30, 20, 15};  // [mm]

/// Points on an ellipsoid in a binary PLY, evenly over the unit sphere (Fibonacci's spiral), every coordinate a float.
void write_ellipsoid(const std::filesystem::path& path, std::size_t points) {
  std::ofstream file(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << points
       << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t i = 0; i < points; ++i) {
    const double k = static_cast<double>(i), z = 1 - (2 * k + 1) / static_cast<double>(points);
    const double r = std::sqrt(1 - z * z);
    const std::array<float, 3> p{static_cast<float>(kAxes[0] * r * std::cos(turn * k)),
                                 static_cast<float>(kAxes[1] * r * std::sin(turn * k)),
                                 static_cast<float>(kAxes[2] * z)};
    file.write(reinterpret_cast<const char*>(p.data()), sizeof p);
  }
}

TEST(LargeCloud, StaysWithinItsMemory) {
  const char* const asked = std::getenv("TALUS_LARGE_POINTS");
  const auto points = static_cast<std::size_t>(asked ? std::atof(asked) : 1e6);
  const test_support::TemporaryFolder folder;
  write_ellipsoid(folder / "cloud.ply", points);
  const std::clock_t start = std::clock();
  const CloudReading reading;
  const std::size_t blocks = (points + reading.point_limit - 1) / reading.point_limit;
  if (asked) {
    DigitizationOptions options;
    options.metres_per_unit = 1e-3;
    const catalog::ShapeRecord shape = digitize(folder / "cloud.ply", options);
    const double volume = 4e-9 / 3 * std::numbers::pi * kAxes[0] * kAxes[1] * kAxes[2];
    std::cout << points << " points: " << static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC << " CPU s, peak "
              << peak_megabytes() << " MB, volume error " << 100 * (shape.mass_properties.volume / volume - 1)
              << " %\n";
    EXPECT_NEAR(shape.mass_properties.volume, volume, 1e-3 * volume);
  } else {
    const CloudFile file = read_cloud(folder / "cloud.ply", reading);
    EXPECT_EQ(file.cloud.points.size(), points / blocks);
    EXPECT_EQ(file.left_out_points, points - points / blocks);
  }
  // What is kept of the cloud, and the file's bytes, which are mapped; 4 GB is the bound for 50,000,000 points.
  EXPECT_LT(peak_megabytes(), 1000 + static_cast<double>(points) * 60e-6);
}

}  // namespace
}  // namespace shape_pipeline
