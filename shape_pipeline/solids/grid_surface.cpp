// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/solids/grid_surface.h"

#include <map>

namespace shape_pipeline {

catalog::TriangleMesh grid_surface(const std::array<std::vector<double>, 3>& planes,
                                   const std::function<bool(int, int, int)>& is_full) {
  using Cell = std::array<int, 3>;
  catalog::TriangleMesh mesh;
  std::map<Cell, int> numbers;
  const auto vertex = [&](const Cell& p) {
    const auto [found, is_new] = numbers.try_emplace(p, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back({planes[0][p[0]], planes[1][p[1]], planes[2][p[2]]});
    return found->second;
  };
  Cell count;
  for (int i = 0; i < 3; ++i) count[i] = static_cast<int>(planes[i].size()) - 1;
  const auto full = [&](const Cell& c) {
    for (int i = 0; i < 3; ++i)
      if (c[i] < 0 || c[i] >= count[i]) return false;
    return is_full(c[0], c[1], c[2]);
  };
  const auto add_side = [&](const Cell& cell, int axis, int side) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Cell corner = cell;
    corner[axis] += side;
    const int a = vertex(corner);
    ++corner[u];
    const int b = vertex(corner);
    ++corner[v];
    const int c = vertex(corner);
    --corner[u];
    const int d = vertex(corner);
    if (side == 1)
      mesh.faces.insert(mesh.faces.end(), {{a, b, c}, {a, c, d}});
    else
      mesh.faces.insert(mesh.faces.end(), {{a, c, b}, {a, d, c}});
  };
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k) {
        if (!is_full(i, j, k)) continue;
        for (int axis = 0; axis < 3; ++axis)
          for (int side = 0; side < 2; ++side) {
            Cell other{i, j, k};
            other[axis] += 2 * side - 1;
            if (!full(other)) add_side({i, j, k}, axis, side);
          }
      }
  return mesh;
}

}  // namespace shape_pipeline
