// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/scenes/placing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/input_error.h"

namespace benchmark_scenes {
namespace {

using dem_gpu::Vec3;

constexpr int kMostEmptyLayers = 1000;

/// Cells along an axis, as many as fit.
int cells_along(double length, double pitch) { return static_cast<int>(std::floor(length / pitch * (1 + 1e-12))); }

}  // namespace

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

dem_gpu::Quaternion random_rotation(std::mt19937_64& random) {
  const double share = uniform(random, 0, 1), a = uniform(random, 0, 2 * std::numbers::pi),
               b = uniform(random, 0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - share), s = std::sqrt(share);
  return {s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)};
}

dem_gpu::Quaternion random_tilt(std::mt19937_64& random, double largest_angle) {
  const double z = uniform(random, -1, 1), turn = uniform(random, 0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return dem_gpu::axis_angle({r * std::cos(turn), r * std::sin(turn), z}, uniform(random, 0, largest_angle));
}

double bounding_radius(const dem_gpu::Shape& shape) {
  if (const auto* sphere = std::get_if<dem_gpu::SphereShape>(&shape.geometry)) return sphere->radius;
  double radius = 0;
  for (const catalog::ConvexPart& part : std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts)
    for (const catalog::Point& vertex : part.vertices)
      radius = std::max(radius, std::hypot(vertex[0], vertex[1], vertex[2]));
  return radius;
}

std::vector<Vec3> lattice_sites(const Lattice& lattice, int count, std::mt19937_64& random) {
  const double least_pitch = 2 * (lattice.reach + lattice.jitter);
  const int across = cells_along(lattice.width, least_pitch), deep = cells_along(lattice.depth, least_pitch);
  if (across < 1 || deep < 1) throw catalog::InputError("benchmark scene: the box is narrower than a body");
  // Cells as wide as the box allows; layers as low as the bodies allow.
  const Vec3 cell{lattice.width / across, lattice.depth / deep, least_pitch};
  std::vector<Vec3> sites;
  for (int layer = 0, empty = 0; static_cast<int>(sites.size()) < count; ++layer) {
    const std::size_t before = sites.size();
    for (int row = 0; row < deep; ++row)
      for (int column = 0; column < across && static_cast<int>(sites.size()) < count; ++column) {
        const Vec3 centre = lattice.low + Vec3{(column + 0.5) * cell.x, (row + 0.5) * cell.y, (layer + 0.5) * cell.z};
        const double j = lattice.jitter;
        const Vec3 shift{uniform(random, -j, j), uniform(random, -j, j), uniform(random, -j, j)};
        if (!lattice.is_free || lattice.is_free(centre)) sites.push_back(centre + shift);
      }
    empty = sites.size() == before ? empty + 1 : 0;
    if (empty == kMostEmptyLayers) throw catalog::InputError("benchmark scene: no room for so many bodies");
  }
  return sites;
}

}  // namespace benchmark_scenes
