// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace workflows {

/// Random numbers that are the same on every machine and compiler: SplitMix64. Steele, Lea & Flood, OOPSLA 2014.
class RandomStream {
 public:
  /// Streams of one seed and different `stream` numbers are independent.
  explicit RandomStream(std::uint64_t seed, std::uint64_t stream = 0) : state_(seed) {
    state_ = next() ^ (stream * 0xd1342543de82ef95ULL);
  }

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // [0, 1)
  double symmetric() { return 2 * uniform() - 1; }                          // [-1, 1)

  /// Uniform in the unit ball of `Dimensions`, by rejection: no library function whose last bit may differ.
  template <std::size_t Dimensions>
  std::array<double, Dimensions> in_unit_ball() {
    std::array<double, Dimensions> point{};
    double squared = 2;
    while (squared > 1) {
      squared = 0;
      for (double& component : point) {
        component = symmetric();
        squared += component * component;
      }
    }
    return point;
  }

  /// Uniform over rotations: unit quaternion (w, x, y, z). Marsaglia, Ann. Math. Stat. 43 (1972) 645.
  std::array<double, 4> rotation() {
    for (;;) {
      std::array<double, 4> q = in_unit_ball<4>();
      const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      if (length < 1e-3) continue;  // direction ill-defined
      for (double& component : q) component /= length;
      return q;
    }
  }

  /// Fisher-Yates.
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i)
      std::swap(items[i - 1], items[static_cast<std::size_t>(uniform() * static_cast<double>(i))]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace workflows
