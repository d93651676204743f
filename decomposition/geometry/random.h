// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "decomposition/geometry/vector3.h"

namespace decomposition {

/// SplitMix64 (Steele, Lea & Flood 2014): the same numbers on every machine, a stream for every seed.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) { next(); }

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  Vec3 unit_vector() {
    const double z = 2 * uniform() - 1, angle = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::uint64_t state_;
};

/// A seed for sub-task `index` of a task, far from its neighbours'.
inline std::uint64_t sub_seed(std::uint64_t seed, std::uint64_t index) {
  return Random(seed * 0xD1342543DE82EF95ull + index).next();
}

/// Three random orthonormal rows: a rotation.
struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3 operator()(const Vec3& p) const { return {dot(x, p), dot(y, p), dot(z, p)}; }
};

inline Frame random_frame(Random& random) {
  Frame frame;
  frame.z = random.unit_vector();
  Vec3 u, v;
  plane_axes(frame.z, u, v);
  const double angle = 2 * std::numbers::pi * random.uniform();
  frame.x = std::cos(angle) * u + std::sin(angle) * v;
  frame.y = cross(frame.z, frame.x);
  return frame;
}

/// Direction `index` of `count` spread evenly over the sphere (spherical Fibonacci set).
inline Vec3 spread_direction(int index, int count) {
  const double z = 1 - (2.0 * index + 1) / count;
  const double angle = index * std::numbers::pi * (3 - std::sqrt(5.0)), r = std::sqrt(std::fmax(0.0, 1 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace decomposition
