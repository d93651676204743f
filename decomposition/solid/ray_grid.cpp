// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/ray_grid.h"

#include <algorithm>
#include <utility>

namespace decomposition {
namespace {

struct Hit {
  std::size_t ray;
  double z;
  int entering;  // +1 for a downward-facing surface: going up, the ray enters there
};

/// Which side of edge p -> q the place (x, y) lies on. The arithmetic runs on the ordered edge, so that both triangles
/// at the edge get the same number, and a place exactly on it belongs to one of them only.
bool is_left_of(const Vec3& p, const Vec3& q, double x, double y) {
  const bool ordered = p.x < q.x || (p.x == q.x && p.y < q.y);
  const Vec3 &a = ordered ? p : q, &b = ordered ? q : p;
  const double side = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  return ordered ? side >= 0 : side < 0;
}

void collect_hits(const RayGrid& grid, const std::array<Vec3, 3>& corner, std::vector<Hit>& hits) {
  Vec3 a = corner[0], b = corner[1], c = corner[2];
  const double twice_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (twice_area == 0) return;
  const int entering = twice_area < 0 ? 1 : -1;
  if (twice_area < 0) std::swap(b, c);
  const auto range = [&](double low, double high, double origin, int n) {
    const double first = std::floor((low - origin) / grid.cell), last = std::floor((high - origin) / grid.cell);
    return std::pair<int, int>(static_cast<int>(std::clamp(first, 0.0, n - 1.0)),
                               static_cast<int>(std::clamp(last, -1.0, n - 1.0)));
  };
  const auto [i0, i1] = range(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), grid.x0, grid.nx);
  const auto [j0, j1] = range(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), grid.y0, grid.ny);
  const Vec3 normal = cross(b - a, c - a);
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      const double x = grid.x(i, j), y = grid.y(i, j);
      if (!is_left_of(a, b, x, y) || !is_left_of(b, c, x, y) || !is_left_of(c, a, x, y)) continue;
      const double z = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
      hits.push_back({grid.index(i, j), std::clamp(z, std::min({a.z, b.z, c.z}), std::max({a.z, b.z, c.z})), entering});
    }
}

}  // namespace

RayIntervals intersect(const RayGrid& grid, const std::vector<Vec3>& vertices,
                       const std::vector<std::array<int, 3>>& faces) {
  std::vector<Hit> hits;
  for (const auto& face : faces)
    collect_hits(grid,
                 {vertices[static_cast<std::size_t>(face[0])], vertices[static_cast<std::size_t>(face[1])],
                  vertices[static_cast<std::size_t>(face[2])]},
                 hits);
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    if (a.ray != b.ray) return a.ray < b.ray;
    return a.z != b.z ? a.z < b.z : a.entering > b.entering;
  });
  RayIntervals result;
  result.first.assign(static_cast<std::size_t>(grid.count()) + 1, 0);
  std::size_t h = 0;
  for (std::size_t ray = 0; ray < static_cast<std::size_t>(grid.count()); ++ray) {
    result.first[ray] = result.intervals.size();
    int winding = 0;
    double entered = 0, last = 0;
    for (; h < hits.size() && hits[h].ray == ray; ++h) {
      const int before = winding;
      if (before > 1) result.repeated += (before - 1) * (hits[h].z - last);
      if (before < 0) result.inverted -= before * (hits[h].z - last);
      last = hits[h].z;
      winding += hits[h].entering;
      if (before <= 0 && winding > 0) entered = hits[h].z;
      if (before > 0 && winding <= 0 && hits[h].z > entered) result.intervals.push_back({entered, hits[h].z});
    }
  }
  result.first.back() = result.intervals.size();
  return result;
}

}  // namespace decomposition
