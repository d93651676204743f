// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace workflows {

/// xoshiro256** of Blackman & Vigna 2021 (ACM TOMS 47:36), seeded by their splitmix64. Same numbers on every platform,
/// which the standard library's distributions do not promise.
class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed);

  std::uint64_t next();
  double uniform();                          // [0, 1), in steps of 2^-53
  std::uint64_t below(std::uint64_t bound);  // 0 ... bound - 1, each equally likely; bound > 0

 private:
  std::array<std::uint64_t, 4> state_;
};

/// `count` indices drawn with replacement: index i with probability weights[i] / sum. Equal weights are drawn without
/// rounding. Throws std::invalid_argument if a weight is negative or not finite, or all are zero.
std::vector<std::size_t> draw(const std::vector<double>& weights, std::size_t count, std::uint64_t seed);

}  // namespace workflows
