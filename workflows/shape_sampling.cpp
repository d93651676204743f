// SPDX-License-Identifier: Apache-2.0
#include "workflows/shape_sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace workflows {

RandomSource::RandomSource(std::uint64_t seed) {
  for (std::uint64_t& word : state_) {
    seed += 0x9e3779b97f4a7c15;
    std::uint64_t z = seed;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    word = z ^ z >> 31;
  }
}

std::uint64_t RandomSource::next() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double RandomSource::uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

std::uint64_t RandomSource::below(std::uint64_t bound) {
  // The first 2^64 mod bound numbers are passed over: what is left is a multiple of bound.
  const std::uint64_t passed_over = -bound % bound;
  std::uint64_t number = next();
  while (number < passed_over) number = next();
  return number % bound;
}

std::vector<std::size_t> draw(const std::vector<double>& weights, std::size_t count, std::uint64_t seed) {
  std::vector<double> cumulative;
  double sum = 0;
  for (const double weight : weights) {
    if (!(weight >= 0) || std::isinf(weight)) throw std::invalid_argument("a weight is negative or not finite");
    cumulative.push_back(sum += weight);
  }
  if (!(sum > 0) || std::isinf(sum)) throw std::invalid_argument("the weights have no finite positive sum");

  const bool is_equal = std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights[0]; });
  RandomSource random(seed);
  std::vector<std::size_t> drawn;
  drawn.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (is_equal) {
      drawn.push_back(random.below(weights.size()));
      continue;
    }
    // upper_bound passes over entries of weight 0; rounding of the product to the sum itself is led back to the last
    // entry that has a weight.
    const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), random.uniform() * sum);
    const auto last = std::lower_bound(cumulative.begin(), cumulative.end(), sum);
    drawn.push_back(static_cast<std::size_t>(std::min(found, last) - cumulative.begin()));
  }
  return drawn;
}

}  // namespace workflows
