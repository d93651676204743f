// SPDX-License-Identifier: GPL-3.0-or-later
// measure_error against Booleans in exact arithmetic: the error that it states of itself must cover the difference.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "decomposition/convex_decomposition.h"
#include "decomposition/decomposition_quality.h"
#include "tests/property/decomposition/exact_difference.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

struct Case {
  std::string name;
  catalog::TriangleMesh mesh;
  int parts;
  FitMode mode = FitMode::volume_true;
};

/// A lumpy body of 128 faces, no two cases alike.
catalog::TriangleMesh lumpy(double k) {
  return solids::star(
      [k](const catalog::Point& d) { return 1 + 0.25 * std::cos(5 * d[0] + k) * std::sin(4 * d[1] - k) + 0.1 * d[2]; },
      2);
}

std::vector<Case> cases() {
  std::vector<Case> all{{"cross in one part", solids::flat_cross(), 1},
                        {"torus in 4 parts", solids::torus(1, 0.4, 12, 6), 4},
                        {"lumpy needle", solids::scaled(lumpy(1.5), {30, 1, 1}), 2},
                        {"lumpy body, enclosed", lumpy(0.5), 2, FitMode::enclosing},
                        {"lumpy body, inscribed", lumpy(2.5), 2, FitMode::inscribed}};
  for (int k = 1; k <= 4; ++k) all.push_back({"lumpy body " + std::to_string(k), lumpy(k), 1 + k % 3});
  return all;
}

TEST(ExactError, StatedErrorCoversTheTruth) {
  double squares = 0;
  int count = 0;
  for (const Case& one : cases()) {
    DecompositionOptions options;
    options.parts = one.parts;
    options.vertex_cap = 16;
    options.mode = one.mode;
    options.effort = 0.1;
    const catalog::LevelOfDetail level = decompose(one.mesh, options);
    const exact::Volumes truth = exact::volumes(one.mesh, level.parts);
    const double difference = (truth.mesh + truth.parts - 2 * truth.common) / truth.mesh;
    const double missing = (truth.mesh - truth.common) / truth.mesh;
    // The standard error is that of four sets of rays: in one case of 100 the mean is 5.8 of it off (Student's t, 3
    // degrees of freedom), and the cases are always the same.
    EXPECT_GT(level.error.method_error, 0) << one.name;
    EXPECT_LT(level.error.method_error, 1e-3) << one.name;
    EXPECT_NEAR(level.error.symmetric_difference, difference, 5.8 * level.error.method_error) << one.name;
    EXPECT_NEAR(level.error.missing_volume, missing, 5.8 * level.error.method_error) << one.name;
    EXPECT_NEAR(level.error.volume_error, truth.parts / truth.mesh - 1, 1e-12)
        << one.name << ": exact, but for rounding";
    squares += std::pow((level.error.symmetric_difference - difference) / level.error.method_error, 2);
    ++count;
  }
  // Expected: sqrt 3, the standard deviation of that distribution.
  EXPECT_LT(std::sqrt(squares / count), 2 * std::sqrt(3.0));
}

}  // namespace
}  // namespace decomposition
