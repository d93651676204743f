// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of a large mesh. TALUS_LARGE_FACES sets its faces (`make large-mesh`: 2,000,000); 200,000 by default.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <numbers>

#include "decomposition/convex_decomposition.h"
#include "decomposition/decomposition_quality.h"
#include "tests/support/partition_checks.h"

namespace decomposition {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// A bumpy rock of about `face_count` faces on a grid of longitudes and latitudes.
catalog::TriangleMesh bumpy_rock(double face_count) {
  const int rows = static_cast<int>(std::sqrt(face_count / 4)), columns = 2 * rows;
  catalog::TriangleMesh mesh;
  const auto add = [&](double polar, double azimuth) {
    const double x = std::sin(polar) * std::cos(azimuth), y = std::sin(polar) * std::sin(azimuth), z = std::cos(polar);
    const double radius = 1 + 0.1 * std::sin(3 * x + 1) * std::cos(4 * y) + 0.06 * std::sin(7 * z + 2 * x) +
                          0.004 * std::sin(60 * x) * std::sin(70 * y + 50 * z);
    mesh.vertices.push_back({1.3 * radius * x, radius * y, 0.8 * radius * z});
  };
  add(0, 0);
  for (int row = 1; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      add(std::numbers::pi * row / rows, 2 * std::numbers::pi * column / columns);
  add(std::numbers::pi, 0);
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int row, int column) {
    return row == 0 ? 0 : (row == rows ? last : 1 + (row - 1) * columns + column % columns);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int a = at(row, column), b = at(row + 1, column), c = at(row + 1, column + 1), d = at(row, column + 1);
      if (row + 1 < rows) mesh.faces.push_back({a, b, c});
      if (row > 0) mesh.faces.push_back({a, c, d});
    }
  return mesh;
}

TEST(LargeMesh, StaysWithinItsMemory) {
  const char* asked = std::getenv("TALUS_LARGE_FACES");
  const double face_count = asked ? std::atof(asked) : 2e5;
  const catalog::TriangleMesh rock = bumpy_rock(face_count);
  DecompositionOptions options;
  options.vertex_cap = 64;
  options.effort = asked ? 1 : 0.1;
  options.threads = 2;
  const double start = cpu_seconds();
  const catalog::LevelOfDetail level = decompose(rock, options);
  const double decomposed = cpu_seconds();
  measure_error(rock, level.parts);
  std::cout << rock.face_count() << " faces, 8 parts of 64 vertices: decompose " << decomposed - start
            << " CPU s (measuring included), measure_error " << cpu_seconds() - decomposed << " CPU s, peak "
            << peak_megabytes() << " MB\n";
  partition_checks::expect_partition(level);
  EXPECT_NEAR(level.error.volume_error, 0, 1e-3);
  EXPECT_LT(level.error.symmetric_difference, 0.02);
  // Grids and search take some 100 MB whatever the mesh; 1 GB is the bound for 2,000,000 faces.
  EXPECT_LT(peak_megabytes(), 150 + face_count * 425e-6);
}

}  // namespace
}  // namespace decomposition
