// SPDX-License-Identifier: Apache-2.0
#include "workflows/shape_sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace workflows;

// splitmix64 from 0 begins e220a8397b1dcdaf (Vigna's reference code), 6e789e6aa1b965f4, 06c45d188009454f,
// f88bb8a8724c81ec; xoshiro256** from that state yields rotl(s1 * 5, 7) * 9 first.
TEST(RandomSource, FirstNumberFollowsFromTheDefinition) {
  const std::uint64_t s1 = 0x6e789e6aa1b965f4;
  const std::uint64_t product = s1 * 5;
  EXPECT_EQ(RandomSource(0).next(), (product << 7 | product >> 57) * 9);
  EXPECT_EQ(RandomSource(0).next(), 0x99ec5f36cb75f2b4u);
}

TEST(RandomSource, NumbersStayInTheirRanges) {
  RandomSource random(1);
  for (int i = 0; i < 10000; ++i) {
    const double u = random.uniform();
    ASSERT_TRUE(u >= 0 && u < 1);
    ASSERT_LT(random.below(7), 7u);
    ASSERT_EQ(random.below(1), 0u);
  }
}

/// Largest deviation of counts from n p in standard deviations.
double worst_deviation(const std::vector<std::size_t>& drawn, const std::vector<double>& weights) {
  double sum = 0, worst = 0;
  for (const double weight : weights) sum += weight;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double n = static_cast<double>(drawn.size()), p = weights[i] / sum;
    const double count = static_cast<double>(std::count(drawn.begin(), drawn.end(), i));
    if (p == 0 || p == 1) {
      EXPECT_EQ(count, n * p);
    } else {
      worst = std::max(worst, std::abs(count - n * p) / std::sqrt(n * p * (1 - p)));
    }
  }
  return worst;
}

TEST(Draw, CountsFollowTheWeights) {
  for (const std::vector<double>& weights :
       {std::vector<double>{1, 1, 1, 1, 1}, {1, 2, 3, 4}, {0, 1, 0, 5, 0}, {1e-9, 2e-9}, {3}})
    EXPECT_LT(worst_deviation(draw(weights, 100000, 11), weights), 4);
}

TEST(Draw, SeedDecidesAll) {
  EXPECT_EQ(draw({1, 2, 3}, 100, 5), draw({1, 2, 3}, 100, 5));
  EXPECT_NE(draw({1, 2, 3}, 100, 5), draw({1, 2, 3}, 100, 6));
  // The first of a longer draw are those of a shorter one.
  const auto longer = draw({1, 2, 3}, 100, 5), shorter = draw({1, 2, 3}, 10, 5);
  EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longer.begin()));
  EXPECT_TRUE(draw({1}, 0, 5).empty());
}

TEST(Draw, RefusesWhatIsNoWeight) {
  EXPECT_THROW(draw({}, 1, 1), std::invalid_argument);
  EXPECT_THROW(draw({0, 0}, 1, 1), std::invalid_argument);
  EXPECT_THROW(draw({1, -1e-9}, 1, 1), std::invalid_argument);
  EXPECT_THROW(draw({1, std::numeric_limits<double>::quiet_NaN()}, 1, 1), std::invalid_argument);
  EXPECT_THROW(draw({1, std::numeric_limits<double>::infinity()}, 1, 1), std::invalid_argument);
}

}  // namespace
