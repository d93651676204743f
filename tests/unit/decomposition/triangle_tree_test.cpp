// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/quality/triangle_tree.h"

#include <gtest/gtest.h>

#include <limits>

#include "decomposition/geometry/random.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

TEST(TriangleTree, DistanceToACubeIsAnalytic) {
  const catalog::TriangleMesh cube = solids::voxels(
      1, [](int, int, int) { return true; }, 6);
  std::vector<std::array<Vec3, 3>> triangles;
  for (const auto& [a, b, c] : cube.faces)
    triangles.push_back({to_vec3(cube.vertices[a]), to_vec3(cube.vertices[b]), to_vec3(cube.vertices[c])});
  const TriangleTree tree(triangles);
  Random random(1);
  for (int k = 0; k < 500; ++k) {
    const Vec3 p{3 * random.uniform() - 1, 3 * random.uniform() - 1, 3 * random.uniform() - 1};
    const auto beyond = [](double x) { return std::fmax(std::fmax(-x, x - 1), 0.0); };
    double truth = std::hypot(beyond(p.x), beyond(p.y), beyond(p.z));
    if (truth == 0) {
      truth = 1;
      for (const double x : {p.x, p.y, p.z}) truth = std::fmin(truth, std::fmin(x, 1 - x));
    }
    EXPECT_NEAR(tree.distance(p), truth, 1e-14);
  }
}

TEST(TriangleTree, EmptyTreeIsInfinitelyFar) {
  EXPECT_EQ(TriangleTree({}).distance({0, 0, 0}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace decomposition
