// SPDX-License-Identifier: Apache-2.0
// A face of one body that lies exactly in a cut plane inside the other one counts once, whatever the cut.
#include <gtest/gtest.h>

#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;

TEST(CutPlanes, FaceInACutPlaneCountsOnce) {
  std::mt19937 random(29);
  const PairIntegrals whole({unit_cube()}, {unit_cube()});
  const Placed offsets[] = {{{0.5, 0.5, 0.99}, {}}, {{0.5, 0, 0.98}, {}}, {{0.5, 0.5, 0.5}, {}}, {{0.5, 0.2, 0.9}, {}}};
  for (const std::array<int, 3>& cut : {std::array<int, 3>{2, 1, 1}, {2, 2, 2}})
    for (const std::array<int, 3>& cut_b : {std::array<int, 3>{1, 1, 1}, {2, 2, 2}}) {
      const PairIntegrals parts(cut_box({1, 1, 1}, cut), cut_box({1, 1, 1}, cut_b));
      for (const Placed& b : offsets)
        for (int i = 0; i < 10; ++i) {  // the same pair in other common attitudes
          const Quaternion turn = i == 0 ? Quaternion{} : random_rotation(random);
          const Placed a_here{{}, turn}, b_here{rotate(turn, b.position), turn};
          const auto one = whole.of<dem_gpu::DepthIntegrals>(a_here, b_here);
          const auto many = parts.of<dem_gpu::DepthIntegrals>(a_here, b_here);
          EXPECT_LT(norm(one.force - many.force), 1e-10 + kSingle.integral);
          EXPECT_LT(norm(one.moment - many.moment), 1e-10 + kSingle.integral);
          const auto volume = whole.of<dem_gpu::VolumeIntegrals>(a_here, b_here);
          const auto volumes = parts.of<dem_gpu::VolumeIntegrals>(a_here, b_here);
          EXPECT_NEAR(volume.volume, volumes.volume, 1e-10 + kSingle.integral);
          EXPECT_LT(norm(volume.area - volumes.area), 1e-10 + kSingle.integral);
        }
    }
}

}  // namespace
