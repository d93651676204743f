// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/stack_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape_pipeline/surfaces/vector3.h"
#include "shape_pipeline/volumes/grey_filters.h"
#include "shape_pipeline/volumes/stack_file.h"

namespace shape_pipeline {
namespace {

constexpr double kTint = 0.34;             // share of a grain's colour within it
constexpr double kReach = 2, kStep = 0.1;  // of the search for the threshold [voxels]
constexpr std::size_t kSamples = 200000;   // voxels that set black and white of the pictures

/// The directions of a picture's columns and rows.
struct PictureAxes {
  std::size_t across, right, down;
};

PictureAxes axes_of(int axis) {
  if (axis == 0) return {0, 1, 2};
  if (axis == 1) return {1, 0, 2};
  return {2, 0, 1};
}

/// A picture's pixels in the plane.
struct PixelGrid {
  PictureAxes axes;
  double left = 0, top = 0, pixel = 0;  // [m]
  int width = 0, height = 0;

  Point place(int x, int y, double depth) const {
    Point point{};
    point[axes.across] = depth;
    point[axes.right] = left + (x + 0.5) * pixel;
    point[axes.down] = top + (y + 0.5) * pixel;
    return point;
  }
};

PixelGrid pixel_grid(const VoxelGrid& voxels, const StackSection& section) {
  PixelGrid grid;
  grid.axes = axes_of(section.axis);
  std::array<double, 2> extent;
  const std::array<std::size_t, 2> directions{grid.axes.right, grid.axes.down};
  for (std::size_t k = 0; k < 2; ++k)
    extent[k] =
        section.half_width > 0 ? 2 * section.half_width : voxels.size[directions[k]] * voxels.spacing[directions[k]];
  grid.pixel = std::max(extent[0], extent[1]) / section.side;
  grid.width = std::max(1, static_cast<int>(std::lround(extent[0] / grid.pixel)));
  grid.height = std::max(1, static_cast<int>(std::lround(extent[1] / grid.pixel)));
  grid.left = section.centre[grid.axes.right] - extent[0] / 2;
  grid.top = section.centre[grid.axes.down] - extent[1] / 2;
  return grid;
}

/// Columns [pixels] at which the middle of each row crosses the surface's outline in the plane.
std::vector<std::vector<double>> crossings(const catalog::TriangleMesh& mesh, const PixelGrid& grid, double depth) {
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(grid.height));
  for (const catalog::Triangle& face : mesh.faces) {
    std::vector<std::array<double, 2>> cut;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& a = mesh.vertices[static_cast<std::size_t>(face[k])];
      const Point& b = mesh.vertices[static_cast<std::size_t>(face[(k + 1) % 3])];
      const double below = a[grid.axes.across] - depth, above = b[grid.axes.across] - depth;
      if ((below >= 0) == (above >= 0)) continue;
      const Point p = add(a, scaled(subtract(b, a), below / (below - above)));
      cut.push_back({(p[grid.axes.right] - grid.left) / grid.pixel, (p[grid.axes.down] - grid.top) / grid.pixel - 0.5});
    }
    if (cut.size() != 2) continue;
    const auto [low, high] = std::minmax({cut[0][1], cut[1][1]});
    for (int y = std::max(0, static_cast<int>(std::ceil(low))); y < grid.height && y < high; ++y)
      rows[static_cast<std::size_t>(y)].push_back(cut[0][0] +
                                                  (y - cut[0][1]) / (cut[1][1] - cut[0][1]) * (cut[1][0] - cut[0][0]));
  }
  for (std::vector<double>& row : rows) std::sort(row.begin(), row.end());
  return rows;
}

void tint(ColourImage& image, const ColouredGrain& grain, const PixelGrid& grid, double depth) {
  const auto rows = crossings(grain.mesh, grid, depth);
  const auto is_inside = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= grid.width || y >= grid.height) return false;
    const std::vector<double>& row = rows[static_cast<std::size_t>(y)];
    return (std::lower_bound(row.begin(), row.end(), x + 0.5) - row.begin()) % 2 == 1;
  };
  for (int y = 0; y < grid.height; ++y) {
    const std::vector<double>& row = rows[static_cast<std::size_t>(y)];
    if (row.empty()) continue;
    const int first = std::max(0, static_cast<int>(row.front()));
    for (int x = first; x < grid.width && x <= row.back(); ++x) {
      if (!is_inside(x, y)) continue;
      const bool is_rim = !is_inside(x - 1, y) || !is_inside(x + 1, y) || !is_inside(x, y - 1) || !is_inside(x, y + 1);
      image(x, y) = mixed(image(x, y), grain.colour, is_rim ? 1 : kTint);
    }
  }
}

double voxel(const GreyVolume& volume, std::size_t index) {
  return std::visit([&](const auto& values) { return static_cast<double>(values[index]); }, volume.values);
}

/// Unit normals of the vertices, of the faces about them by area.
std::vector<Point> vertex_normals(const catalog::TriangleMesh& mesh) {
  std::vector<Point> normals(mesh.vertices.size());
  for (const catalog::Triangle& face : mesh.faces) {
    const Point& origin = mesh.vertices[static_cast<std::size_t>(face[0])];
    const Point area = cross(subtract(mesh.vertices[static_cast<std::size_t>(face[1])], origin),
                             subtract(mesh.vertices[static_cast<std::size_t>(face[2])], origin));
    for (const int v : face) {
      Point& normal = normals[static_cast<std::size_t>(v)];
      normal = add(normal, area);
    }
  }
  for (Point& normal : normals) normal = normalized(normal);
  return normals;
}

}  // namespace

StackPictures::StackPictures(const std::filesystem::path& stack, const StackOptions& options)
    : volume_(read_stack(stack, {options.voxel_size, options.memory_limit})) {
  if (options.denoising == StackDenoising::median) median_filter(volume_);
  if (options.denoising == StackDenoising::gaussian) gaussian_filter(volume_, options.gaussian_sigma);
  std::vector<double> sample;
  const std::size_t count = volume_.grid.count(), step = std::max<std::size_t>(1, count / kSamples);
  for (std::size_t i = 0; i < count; i += step) sample.push_back(voxel(volume_, i));
  std::sort(sample.begin(), sample.end());
  dark_ = sample[sample.size() / 1000];
  bright_ = std::max(dark_ + 1, sample[sample.size() - 1 - sample.size() / 1000]);
}

Point StackPictures::middle() const {
  Point middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.5 * (volume_.grid.size[k] - 1) * volume_.grid.spacing[k];
  return middle;
}

double StackPictures::grey(const Point& place) const {
  std::array<int, 3> low, high;
  std::array<double, 3> share;
  for (std::size_t k = 0; k < 3; ++k) {
    const int last = volume_.grid.size[k] - 1;
    const double at = std::clamp(place[k] / volume_.grid.spacing[k], 0.0, static_cast<double>(last));
    low[k] = static_cast<int>(at);
    high[k] = std::min(low[k] + 1, last);
    share[k] = at - low[k];
  }
  double sum = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::array<int, 3> index;
    double weight = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_high = (corner >> k & 1U) != 0;
      index[k] = is_high ? high[k] : low[k];
      weight *= is_high ? share[k] : 1 - share[k];
    }
    if (weight > 0) sum += weight * voxel(volume_, volume_.grid.index(index[0], index[1], index[2]));
  }
  return sum;
}

ColourImage StackPictures::section(const StackSection& section, const std::vector<ColouredGrain>& grains) const {
  const PixelGrid grid = pixel_grid(volume_.grid, section);
  const double depth = section.centre[grid.axes.across];
  ColourImage image(grid.width, grid.height, {0, 0, 0});
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      const double share = std::clamp((grey(grid.place(x, y, depth)) - dark_) / (bright_ - dark_), 0.0, 1.0);
      image(x, y).fill(static_cast<std::uint8_t>(std::lround(255 * share)));
    }
  for (const ColouredGrain& grain : grains) tint(image, grain, grid, depth);
  return image;
}

DeviationMap StackPictures::deviation(const catalog::TriangleMesh& grain, double threshold) const {
  const double level = (threshold - volume_.offset) / volume_.step;
  const double side = *std::min_element(volume_.grid.spacing.begin(), volume_.grid.spacing.end());
  const std::vector<Point> normals = vertex_normals(grain);
  std::vector<double> values(grain.vertices.size(), std::numeric_limits<double>::quiet_NaN());
  const int steps = static_cast<int>(std::lround(kReach / kStep));
  for (std::size_t v = 0; v < values.size(); ++v) {
    const auto grey_at = [&](int step) {
      return grey(add(grain.vertices[v], scaled(normals[v], step * kStep * side)));
    };
    // The nearest passage from bright to dark on the way out.
    for (int reach = 0; reach < steps && !std::isfinite(values[v]); ++reach)
      for (const int begin : {reach, -reach - 1}) {
        const double inner = grey_at(begin), outer = grey_at(begin + 1);
        if (inner < level || outer >= level) continue;
        values[v] = -(begin + (inner - level) / (inner - outer)) * kStep * side;
        break;
      }
  }
  return with_statistics(std::move(values));
}

}  // namespace shape_pipeline
