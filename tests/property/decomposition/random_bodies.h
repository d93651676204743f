// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "decomposition/geometry/random.h"
#include "tests/support/solids.h"

/// Closed meshes drawn at random, the same for the same seed.
namespace random_bodies {

using decomposition::Random;
using decomposition::to_vec3;
using decomposition::Vec3;

/// A lumpy closed body: a ball with random cuts, bumps and a stretch.
inline catalog::TriangleMesh random_rock(std::uint64_t seed, int levels = 4) {
  Random random(seed);
  std::vector<std::pair<Vec3, double>> cuts, bumps;
  for (int k = 0; k < 12; ++k) cuts.emplace_back(random.unit_vector(), 0.55 + 0.4 * random.uniform());
  for (int k = 0; k < 10; ++k) bumps.emplace_back(random.unit_vector(), 0.5 * random.uniform() - 0.3);
  catalog::TriangleMesh mesh = solids::star(
      [&](const catalog::Point& direction) {
        const Vec3 d = to_vec3(direction);
        double radius = 1;
        for (const auto& [normal, offset] : cuts)
          if (const double along = dot(normal, d); along > 0) radius = std::fmin(radius, offset / along);
        for (const auto& [centre, height] : bumps) radius *= 1 + height * std::exp(-12 * (1 - dot(centre, d)));
        return radius;
      },
      levels);
  const Vec3 stretch{0.6 + random.uniform(), 0.6 + random.uniform(), 0.6 + random.uniform()};
  for (catalog::Point& p : mesh.vertices)
    p = {0.01 * stretch.x * p[0], 0.01 * stretch.y * p[1], 0.01 * stretch.z * p[2]};
  return mesh;
}

/// A union of unit boxes that hang together: a random walk through a grid.
inline catalog::TriangleMesh random_union(std::uint64_t seed) {
  Random random(seed);
  std::set<std::array<int, 3>> full;
  std::array<int, 3> at{2, 2, 2};
  for (int step = 0; step < 14; ++step) {
    full.insert(at);
    int& x = at[static_cast<std::size_t>(3 * random.uniform())];
    x = std::clamp(x + (random.uniform() < 0.5 ? -1 : 1), 0, 4);
  }
  return solids::voxels(5, [&](int i, int j, int k) { return full.contains({i, j, k}); });
}

/// A ball cut by random planes, every vertex on the ball's rays: convex but for the steps between its small faces.
inline catalog::TriangleMesh random_convex_solid(std::uint64_t seed) {
  Random random(seed);
  std::vector<std::pair<Vec3, double>> cuts;
  for (int k = 0; k < 14; ++k) cuts.emplace_back(random.unit_vector(), 0.6 + 0.4 * random.uniform());
  return solids::star(
      [&](const catalog::Point& direction) {
        double radius = 1;
        for (const auto& [normal, offset] : cuts)
          if (const double along = dot(normal, to_vec3(direction)); along > 0)
            radius = std::fmin(radius, offset / along);
        return radius;
      },
      3);
}

/// Two to four convex solids in a row, apart or touching at most.
inline catalog::TriangleMesh random_row(std::uint64_t seed) {
  Random random(seed);
  std::vector<catalog::TriangleMesh> solids;
  const int count = 2 + static_cast<int>(3 * random.uniform());
  for (int k = 0; k < count; ++k)
    solids.push_back(solids::moved(random_convex_solid(10 * seed + static_cast<std::uint64_t>(k)),
                                   {2.0 * k, 0.5 * random.uniform(), 0.5 * random.uniform()}));
  return solids::together(solids);
}

/// A shell: a ball, squashed at random, with a hollow of its own form; its wall is `wall` of the radius thick.
inline catalog::TriangleMesh random_shell(std::uint64_t seed, double wall) {
  Random random(seed);
  const catalog::Point squash{1, 0.7 + 0.3 * random.uniform(), 0.7 + 0.3 * random.uniform()};
  return solids::together({solids::scaled(solids::sphere(1, 4), squash),
                           solids::scaled(solids::inside_out(solids::sphere(1 - wall, 4)), squash)});
}

/// A square bowl of the unit box's size, open above.
inline catalog::TriangleMesh bowl(double wall) {
  catalog::TriangleMesh mesh = solids::voxels(3, [](int i, int j, int k) { return !(i == 1 && j == 1 && k > 0); });
  for (catalog::Point& p : mesh.vertices) {
    for (int axis = 0; axis < 2; ++axis) p[axis] = p[axis] <= 1 ? wall * p[axis] : 1 - wall * (3 - p[axis]);
    p[2] = p[2] <= 1 ? wall * p[2] : wall + (1 - wall) * (p[2] - 1) / 2;
  }
  return mesh;
}

/// Smallest width over 2000 directions [m]; a little above the true one.
inline double width(const catalog::TriangleMesh& mesh) {
  Random random(77);
  double least = INFINITY;
  for (int d = 0; d < 2000; ++d) {
    const Vec3 direction = random.unit_vector();
    double low = INFINITY, high = -INFINITY;
    for (const catalog::Point& p : mesh.vertices) {
      low = std::fmin(low, dot(direction, to_vec3(p)));
      high = std::fmax(high, dot(direction, to_vec3(p)));
    }
    least = std::fmin(least, high - low);
  }
  return least;
}

}  // namespace random_bodies
