// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/virtual_stack.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/mass_properties.h"
#include "shape_pipeline/built_in_solids.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/virtual_scan.h"
#include "shape_pipeline/volumes/grey_filters.h"

namespace shape_pipeline {
namespace {

using catalog::Point;
using catalog::TriangleMesh;

constexpr int kRays = 4;            // along y and z in a voxel
constexpr double kFull = 60000;     // of a whole voxel, in the 16 bits of the coverage
constexpr double kTouching = 0.05;  // [voxels]: how near a grain is pushed to those before it

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// About its centroid, of the diameter [voxels], turned at random.
TriangleMesh posed(TriangleMesh mesh, double diameter, RandomStream& random) {
  const catalog::MassProperties mass = catalog::mass_properties(mesh);
  const double scale = diameter / std::cbrt(6 * mass.volume / std::numbers::pi);
  const Point u = random.direction();
  Point v = cross(u, random.direction());
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (double& component : v) component /= length;
  const Point w = cross(u, v);
  for (Point& vertex : mesh.vertices) {
    Point arm{};
    for (std::size_t i = 0; i < 3; ++i) arm[i] = scale * (vertex[i] - mass.centroid[i]);
    for (std::size_t i = 0; i < 3; ++i) vertex[i] = u[i] * arm[0] + v[i] * arm[1] + w[i] * arm[2];
  }
  return mesh;
}

/// Share of each voxel that grains fill.
class Coverage {
 public:
  explicit Coverage(const VoxelGrid& grid) : grid_(grid), values_(grid.count(), 0) {}

  bool meets(const TriangleMesh& mesh, const Point& shift) const {
    return std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Point& vertex) {
      std::array<int, 3> at;
      for (std::size_t i = 0; i < 3; ++i) {
        at[i] = static_cast<int>(std::lround(vertex[i] + shift[i]));
        if (at[i] < 0 || at[i] >= grid_.size[i]) return false;
      }
      return values_[grid_.index(at[0], at[1], at[2])] > 0.5 * kFull;
    });
  }

  void add(const TriangleMesh& mesh) {
    std::array<double, 2> low{1e9, 1e9}, high{-1e9, -1e9};
    for (const Point& vertex : mesh.vertices)
      for (std::size_t i = 0; i < 2; ++i) {
        low[i] = std::min(low[i], vertex[i + 1]);
        high[i] = std::max(high[i], vertex[i + 1]);
      }
    first_ = {static_cast<int>(std::floor(low[0])), static_cast<int>(std::floor(low[1]))};
    rays_ = {kRays * (static_cast<int>(std::ceil(high[0])) - first_[0] + 1),
             kRays * (static_cast<int>(std::ceil(high[1])) - first_[1] + 1)};
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(rays_[0]) * static_cast<std::size_t>(rays_[1]));
    for (const catalog::Triangle& face : mesh.faces) cross_face(mesh, face, crossings);
    for (std::size_t r = 0; r < crossings.size(); ++r) {
      std::sort(crossings[r].begin(), crossings[r].end());
      for (std::size_t k = 0; k + 1 < crossings[r].size(); k += 2) fill(r, crossings[r][k], crossings[r][k + 1]);
    }
  }

  std::vector<std::uint16_t> take() { return std::move(values_); }

 private:
  /// Coordinate of a ray, off the places where vertices of regular meshes lie.
  double ray_at(std::size_t axis, int ray) const { return first_[axis] - 0.5 + (ray + 0.5) / kRays + 1.3e-5; }

  void cross_face(const TriangleMesh& mesh, const catalog::Triangle& face,
                  std::vector<std::vector<double>>& crossings) const {
    std::array<Point, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = mesh.vertices[static_cast<std::size_t>(face[i])];
    const auto first_ray = [&](std::size_t axis) {
      const double low = std::min({p[0][axis + 1], p[1][axis + 1], p[2][axis + 1]});
      return std::max(0, static_cast<int>(std::floor((low - first_[axis] + 0.5) * kRays)) - 1);
    };
    const auto last_ray = [&](std::size_t axis) {
      const double high = std::max({p[0][axis + 1], p[1][axis + 1], p[2][axis + 1]});
      return std::min(rays_[axis] - 1, static_cast<int>(std::ceil((high - first_[axis] + 0.5) * kRays)) + 1);
    };
    for (int j = first_ray(1); j <= last_ray(1); ++j)
      for (int i = first_ray(0); i <= last_ray(0); ++i) {
        std::array<double, 3> weight;
        for (std::size_t k = 0; k < 3; ++k) {
          const Point &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
          weight[k] = (b[1] - a[1]) * (ray_at(1, j) - a[2]) - (b[2] - a[2]) * (ray_at(0, i) - a[1]);
        }
        const bool is_hit = (weight[0] > 0) == (weight[1] > 0) && (weight[1] > 0) == (weight[2] > 0);
        const double sum = weight[0] + weight[1] + weight[2];
        if (is_hit && sum != 0)
          crossings[static_cast<std::size_t>(j) * static_cast<std::size_t>(rays_[0]) + static_cast<std::size_t>(i)]
              .push_back((weight[0] * p[0][0] + weight[1] * p[1][0] + weight[2] * p[2][0]) / sum);
      }
  }

  void fill(std::size_t ray, double from, double to) {
    const int y = first_[0] + static_cast<int>(ray % static_cast<std::size_t>(rays_[0])) / kRays;
    const int z = first_[1] + static_cast<int>(ray / static_cast<std::size_t>(rays_[0])) / kRays;
    for (int x = static_cast<int>(std::lround(from)); x <= static_cast<int>(std::lround(to)); ++x) {
      const double length = std::min(to, x + 0.5) - std::max(from, x - 0.5);
      std::uint16_t& value = values_[grid_.index(x, y, z)];
      value = static_cast<std::uint16_t>(std::min(65535.0, value + kFull / (kRays * kRays) * std::max(0.0, length)));
    }
  }

  VoxelGrid grid_;
  std::vector<std::uint16_t> values_;
  std::array<int, 2> first_{}, rays_{};  // along y and z: voxel of the first ray of the mesh in work, number of rays
};

double reach(const TriangleMesh& mesh) {
  double square = 0;
  for (const Point& v : mesh.vertices) square = std::max(square, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return std::sqrt(square);
}

/// How far from the centre a grain coming in along a direction is stopped by those before it; 0 if by none.
double stop(const Coverage& coverage, const TriangleMesh& mesh, const Point& centre, const Point& direction) {
  const double step = centre[0] / 60;
  const auto shift = [&](double distance) {
    Point place{};
    for (std::size_t i = 0; i < 3; ++i) place[i] = centre[i] + distance * direction[i];
    return place;
  };
  double clear = 1.7 * centre[0];
  while (clear > 0 && !coverage.meets(mesh, shift(clear))) clear -= step;
  if (clear <= 0) return 0;
  double met = clear;
  for (clear += step; clear - met > kTouching;) {
    const double middle = (clear + met) / 2;
    (coverage.meets(mesh, shift(middle)) ? met : clear) = middle;
  }
  return clear;
}

}  // namespace

VirtualStack virtual_stack(const std::vector<TriangleMesh>& meshes, const StackRecipe& recipe) {
  RandomStream random(recipe.seed);
  std::vector<TriangleMesh> grains;
  double largest = 0;
  for (int g = 0; g < recipe.grains; ++g) {
    grains.push_back(posed(meshes[static_cast<std::size_t>(g) % meshes.size()], recipe.diameter, random));
    largest = std::max(largest, reach(grains.back()));
  }
  const int side = static_cast<int>(recipe.diameter * (1.5 * std::cbrt(recipe.grains) + 1.2) + 2 * largest) + 12;
  VirtualStack stack;
  stack.volume.grid = {{side, side, side}, {recipe.voxel, recipe.voxel, recipe.voxel}};
  Coverage coverage(stack.volume.grid);
  const Point centre{side / 2.0, side / 2.0, side / 2.0};
  for (TriangleMesh& grain : grains) {
    Point place = centre;
    double distance = 1e9;
    for (int attempt = 0; attempt < 5; ++attempt) {  // the direction that lets it come nearest
      const Point direction = random.direction();
      const double found = stop(coverage, grain, centre, direction);
      if (found >= distance) continue;
      distance = found;
      for (std::size_t i = 0; i < 3; ++i) place[i] = centre[i] + found * direction[i];
    }
    for (Point& vertex : grain.vertices)
      for (std::size_t i = 0; i < 3; ++i) vertex[i] += place[i];
    coverage.add(grain);
    for (Point& vertex : grain.vertices)
      for (double& coordinate : vertex) coordinate *= recipe.voxel;
    stack.truths.push_back(std::move(grain));
  }
  GreyVolume covered{stack.volume.grid, coverage.take(), 0};
  if (recipe.blur > 0) gaussian_filter(covered, recipe.blur);
  std::vector<std::uint8_t> grey;
  grey.reserve(covered.grid.count());
  for (const std::uint16_t share : std::get<std::vector<std::uint16_t>>(covered.values)) {
    const double value = recipe.dark + (recipe.bright - recipe.dark) * share / kFull + recipe.noise * random.normal();
    grey.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))));
  }
  stack.volume.values = std::move(grey);
  return stack;
}

std::vector<TriangleMesh> stack_grains(int rocks, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<TriangleMesh> grains;
  for (int r = 0; r < rocks; ++r) {
    RockRecipe rock;
    rock.seed = random.bits();
    rock.flatness = random.uniform(0.6, 1);
    rock.elongation = random.uniform(0.6, 1);
    rock.angularity = random.uniform(10, 50);
    rock.notch_depth = r % 4 == 3 ? 0.2 : 0;
    grains.push_back(virtual_rock(rock));
  }
  grains.push_back(built_in_solid({"superquadric", {{"e1", 1}, {"e2", 1}, {"detail", 45}}, 1}).mesh);
  return grains;
}

}  // namespace shape_pipeline
