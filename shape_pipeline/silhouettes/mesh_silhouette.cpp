// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/silhouettes/mesh_silhouette.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace shape_pipeline {
namespace {

constexpr int kLines = 8;  // down a pixel

using Interval = std::pair<double, double>;

/// Adds what of each line a triangle covers; lines of sight that it covers are covered by a face on the far side too.
void add_triangle(const std::array<ImagePoint, 3>& p, std::vector<std::vector<Interval>>& lines) {
  const auto [low, high] = std::minmax({p[0].row, p[1].row, p[2].row});
  const int first = std::max(0, static_cast<int>(std::ceil(low * kLines - 0.5)));
  const int last = std::min(static_cast<int>(lines.size()) - 1, static_cast<int>(std::floor(high * kLines - 0.5)));
  for (int line = first; line <= last; ++line) {
    const double row = (line + 0.5) / kLines;
    double from = 1e300, to = -1e300;
    for (std::size_t k = 0; k < 3; ++k) {
      const ImagePoint &a = p[k], &b = p[(k + 1) % 3];
      if ((a.row <= row) == (b.row <= row)) continue;
      const double column = a.column + (row - a.row) / (b.row - a.row) * (b.column - a.column);
      from = std::min(from, column);
      to = std::max(to, column);
    }
    if (from < to) lines[static_cast<std::size_t>(line)].push_back({from, to});
  }
}

void fill(Raster<float>& coverage, int row, double from, double to) {
  from = std::max(from, 0.0);
  to = std::min(to, static_cast<double>(coverage.width));
  for (int x = static_cast<int>(from); x < to; ++x)
    coverage(x, row) += static_cast<float>((std::min(to, x + 1.0) - std::max<double>(from, x)) / kLines);
}

}  // namespace

Raster<float> mesh_coverage(const catalog::TriangleMesh& mesh, const TurntableProjection& projection, int width,
                            int height) {
  std::vector<ImagePoint> seen;
  for (const catalog::Point& vertex : mesh.vertices) seen.push_back(projection(vertex));
  std::vector<std::vector<Interval>> lines(static_cast<std::size_t>(height * kLines));
  for (const catalog::Triangle& face : mesh.faces) {
    std::array<ImagePoint, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = seen[static_cast<std::size_t>(face[i])];
    const double turn =
        (p[1].column - p[0].column) * (p[2].row - p[0].row) - (p[2].column - p[0].column) * (p[1].row - p[0].row);
    if (turn < 0) add_triangle(p, lines);
  }
  Raster<float> coverage(width, height);
  for (std::size_t line = 0; line < lines.size(); ++line) {
    std::sort(lines[line].begin(), lines[line].end());
    const int row = static_cast<int>(line) / kLines;
    for (std::size_t k = 0; k < lines[line].size();) {
      Interval joined = lines[line][k];
      for (++k; k < lines[line].size() && lines[line][k].first <= joined.second; ++k)
        joined.second = std::max(joined.second, lines[line][k].second);
      fill(coverage, row, joined.first, joined.second);
    }
  }
  return coverage;
}

}  // namespace shape_pipeline
