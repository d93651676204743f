// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/column_measure.h"

#include <algorithm>
#include <limits>

namespace decomposition {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void ColumnMeasure::rasterise(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a);
  if (normal.z == 0) return;
  const RayGrid& rays = solid_.rays();
  const double pitch = rays.cell * stride_;
  const auto row_of = [&](double y) { return static_cast<int>(std::ceil((y - rays.y(0, 0)) / pitch)) - j0_; };
  const auto column_of = [&](double x) { return static_cast<int>(std::ceil((x - rays.x(0, 0)) / pitch)) - i0_; };
  const std::array<const Vec3*, 4> corner{&a, &b, &c, &a};
  const int last_row = std::min(row_of(std::max({a.y, b.y, c.y})), height_);
  for (int j = std::max(row_of(std::min({a.y, b.y, c.y})), 0); j < last_row; ++j) {
    const double y = rays.y(0, 0) + pitch * (j0_ + j);
    double left = kInfinity, right = -kInfinity;
    for (int e = 0; e < 3; ++e) {  // each edge from its lower end: both its triangles get the same crossing
      const Vec3 *low = corner[static_cast<std::size_t>(e)], *high = corner[static_cast<std::size_t>(e) + 1];
      if (high->y < low->y) std::swap(low, high);
      if (!(low->y <= y && y < high->y)) continue;
      const double x = low->x + (y - low->y) / (high->y - low->y) * (high->x - low->x);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (!(left < right)) continue;
    const int last = std::min(column_of(right), width_);
    const double slope = -normal.x / normal.z * pitch;
    int i = std::max(column_of(left), 0);
    double z = a.z - (normal.x * (rays.x(0, 0) + pitch * (i0_ + i) - a.x) + normal.y * (y - a.y)) / normal.z;
    ZInterval* span = &span_[static_cast<std::size_t>(j) * width_];
    for (; i < last; ++i, z += slope) (normal.z > 0 ? span[i].high : span[i].low) = z;
  }
}

ColumnOverlap ColumnMeasure::operator()(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& faces) {
  const RayGrid& rays = solid_.rays();
  const double pitch = rays.cell * stride_;
  const Box box = bounding_box(points);
  const auto cell_index = [&](double x, double origin, int n, int extra) {
    const double index = std::floor((x - origin) / pitch) + extra;
    return static_cast<int>(std::clamp(index, 0.0, std::ceil(static_cast<double>(n) / stride_)));
  };
  i0_ = cell_index(box.low.x, rays.x(0, 0), rays.nx, 0);
  j0_ = cell_index(box.low.y, rays.y(0, 0), rays.ny, 0);
  width_ = cell_index(box.high.x, rays.x(0, 0), rays.nx, 2) - i0_;
  height_ = cell_index(box.high.y, rays.y(0, 0), rays.ny, 2) - j0_;
  ColumnOverlap sum;
  if (width_ <= 0 || height_ <= 0) return sum;
  span_.assign(static_cast<std::size_t>(width_) * height_, {kInfinity, -kInfinity});
  for (const auto& [a, b, c] : faces)
    rasterise(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)],
              points[static_cast<std::size_t>(c)]);
  const RayIntervals& columns = solid_.columns();
  for (int j = 0; j < height_ && (j0_ + j) * stride_ < rays.ny; ++j)
    for (int i = 0; i < width_ && (i0_ + i) * stride_ < rays.nx; ++i) {
      const ZInterval span = span_[static_cast<std::size_t>(j) * width_ + i];
      if (!(span.low < span.high)) continue;
      sum.volume += span.high - span.low;
      const std::size_t ray = rays.index((i0_ + i) * stride_, (j0_ + j) * stride_);
      for (std::size_t k = columns.first[ray]; k < columns.first[ray + 1]; ++k)
        sum.overlap += std::max(
            0.0, std::min(columns.intervals[k].high, span.high) - std::max(columns.intervals[k].low, span.low));
    }
  sum.volume *= pitch * pitch;
  sum.overlap *= pitch * pitch;
  return sum;
}

}  // namespace decomposition
