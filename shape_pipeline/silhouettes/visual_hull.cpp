// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/silhouettes/visual_hull.h"

#include <algorithm>
#include <cmath>

#include "shape_pipeline/surfaces/vector3.h"
#include "shape_pipeline/volumes/level_surface.h"

namespace shape_pipeline {
namespace {

constexpr int kFirstCells = 64;  // a side of the grid that finds where the hull is
constexpr int kBlock = 8;        // grid points a side of a block
constexpr double kSlope = 1.3;   // most that a depth may change over a distance, in perspective far off the axis
constexpr double kFarError = 2;  // [pixels] of distances far from the outline
constexpr double kSpread = 1.6;  // box of the first grid over the widest silhouette

/// A box of equal cells, its first point at `origin`.
struct HullGrid {
  VoxelGrid grid;
  Point origin{};

  Point at(double x, double y, double z) const {
    return {origin[0] + x * grid.spacing[0], origin[1] + y * grid.spacing[1], origin[2] + z * grid.spacing[2]};
  }
};

/// Signed depth [m]; once below `enough` no further view is asked.
double depth_at(const std::vector<HullView>& views, const Point& point, double enough) {
  double depth = 1e300;
  for (const HullView& view : views) {
    const ImagePoint seen = view.projection(point);
    depth = std::min(depth, seen.metres_per_pixel * view.silhouette.at(seen.column, seen.row));
    if (depth < enough) return depth;
  }
  return depth;
}

/// Farthest that any outline reaches from where the origin is seen, across and along the axis [m].
std::array<double, 2> reach_of(const std::vector<HullView>& views) {
  std::array<double, 2> reach{};
  for (const HullView& view : views) {
    const ImagePoint origin = view.projection({0, 0, 0});
    const SilhouetteImage& seen = view.silhouette;
    reach[0] = std::max({reach[0], (seen.right - origin.column) * origin.metres_per_pixel,
                         (origin.column - seen.left) * origin.metres_per_pixel});
    reach[1] = std::max({reach[1], (seen.bottom - origin.row) * origin.metres_per_pixel,
                         (origin.row - seen.top) * origin.metres_per_pixel});
  }
  return reach;
}

HullGrid cubic_grid(const Point& low, const Point& high, double cell) {
  HullGrid result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.grid.size[i] = static_cast<int>(std::ceil((high[i] - low[i]) / cell)) + 1;
    result.grid.spacing[i] = cell;
  }
  result.origin = low;
  return result;
}

/// How deep outside the middle of a cube may be, while a corner of it is still inside [m].
double margin(const std::vector<HullView>& views, double half_side) {
  return kSlope * std::sqrt(3.0) * half_side + kFarError * views[0].projection({0, 0, 0}).metres_per_pixel;
}

/// A box about the hull; none if it reaches the border of the first grid.
struct Bounds {
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  bool is_open = false;
};

Bounds bounds_of(const std::vector<HullView>& views) {
  const auto [across, along] = reach_of(views);
  const double wide = kSpread * across, high = kSpread * along + across;
  const double cell = 2 * std::max(wide, high) / kFirstCells, enough = -margin(views, cell / 2);
  const HullGrid first = cubic_grid({-wide, -wide, -high}, {wide, wide, high}, cell);
  const std::array<int, 3>& size = first.grid.size;
  Bounds bounds;
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x) {
        const Point middle = first.at(x, y, z);
        if (depth_at(views, middle, enough) < enough) continue;
        for (std::size_t i = 0; i < 3; ++i) {
          bounds.low[i] = std::min(bounds.low[i], middle[i] - cell);
          bounds.high[i] = std::max(bounds.high[i], middle[i] + cell);
        }
        bounds.is_open |= std::min({x, y, z}) == 0 || x == size[0] - 1 || y == size[1] - 1 || z == size[2] - 1;
      }
  return bounds;
}

std::vector<float> depth_field(const std::vector<HullView>& views, const HullGrid& hull) {
  const VoxelGrid& grid = hull.grid;
  const double far = margin(views, (kBlock - 1) / 2.0 * grid.spacing[0]);
  std::vector<float> field(grid.count());
  const auto work_block = [&](const std::array<int, 3>& low) {
    std::array<int, 3> end;
    for (std::size_t i = 0; i < 3; ++i) end[i] = std::min(low[i] + kBlock, grid.size[i]);
    constexpr double kMiddle = (kBlock - 1) / 2.0;
    const double middle = depth_at(views, hull.at(low[0] + kMiddle, low[1] + kMiddle, low[2] + kMiddle), -far);
    const bool is_crossed = std::abs(middle) <= far;
    for (int z = low[2]; z < end[2]; ++z)
      for (int y = low[1]; y < end[1]; ++y)
        for (int x = low[0]; x < end[0]; ++x)
          field[grid.index(x, y, z)] =
              static_cast<float>(is_crossed ? depth_at(views, hull.at(x, y, z), -1e300) : middle);
  };
  for (int z = 0; z < grid.size[2]; z += kBlock)
    for (int y = 0; y < grid.size[1]; y += kBlock)
      for (int x = 0; x < grid.size[0]; x += kBlock) work_block({x, y, z});
  return field;
}

}  // namespace

std::optional<VisualHull> visual_hull(const std::vector<HullView>& views, int cells) {
  const Bounds bounds = bounds_of(views);
  if (bounds.is_open) return std::nullopt;
  VisualHull result;
  if (bounds.low[0] > bounds.high[0]) return result;
  const Point size = subtract(bounds.high, bounds.low);
  result.cell = std::max({size[0], size[1], size[2]}) / cells;
  const HullGrid grid = cubic_grid(bounds.low, bounds.high, result.cell);
  std::vector<float> field = depth_field(views, grid);
  // In cells, since level_surface keeps a least value.
  for (float& depth : field) depth /= static_cast<float>(result.cell);
  const auto inside = std::count_if(field.begin(), field.end(), [](float depth) { return depth > 0; });
  result.counted_volume = static_cast<double>(inside) * grid.grid.voxel_volume();
  result.mesh = level_surface(field, grid.grid);
  for (Point& vertex : result.mesh.vertices) vertex = add(vertex, grid.origin);
  return result;
}

}  // namespace shape_pipeline
