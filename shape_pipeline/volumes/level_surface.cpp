// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/volumes/level_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace shape_pipeline {
namespace {

// The corners of a cell are numbered x + 2 y + 4 z. Each tetrahedron climbs from corner 0 to corner 7 along the axes in
// one of their six orders; the odd orders are listed with two corners exchanged, so that all turn the same way.
constexpr std::array<std::array<int, 4>, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}}};

/// A corner exactly on the surface would make triangles without area.
constexpr float kLeastValue = 1e-4f;

class Marching {
 public:
  Marching(const std::vector<float>& field, const VoxelGrid& grid)
      : field_(field), grid_(grid), lower_(edges_of_layer(), -1), upper_(edges_of_layer(), -1) {}

  catalog::TriangleMesh surface() {
    for (int z = 0; z + 1 < grid_.size[2]; ++z) {
      for (int y = 0; y + 1 < grid_.size[1]; ++y)
        for (int x = 0; x + 1 < grid_.size[0]; ++x) march_cell({x, y, z});
      std::swap(lower_, upper_);
      std::fill(upper_.begin(), upper_.end(), -1);
    }
    return std::move(mesh_);
  }

 private:
  using Cell = std::array<int, 3>;

  std::size_t edges_of_layer() const { return 7 * grid_.index(0, 0, 1); }

  float value(const Cell& cell, int corner) const {
    const float found =
        field_[grid_.index(cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2))];
    return found >= 0 ? std::max(found, kLeastValue) : std::min(found, -kLeastValue);
  }

  void march_cell(const Cell& cell) {
    std::array<float, 8> values;
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      values[static_cast<std::size_t>(c)] = value(cell, c);
      inside += values[static_cast<std::size_t>(c)] > 0;
    }
    if (inside == 0 || inside == 8) return;
    for (const auto& tetrahedron : kTetrahedra) march_tetrahedron(cell, values, tetrahedron);
  }

  void march_tetrahedron(const Cell& cell, const std::array<float, 8>& values, std::array<int, 4> corners) {
    const auto is_inside = [&](int corner) { return values[static_cast<std::size_t>(corner)] > 0; };
    const auto inside = std::count_if(corners.begin(), corners.end(), is_inside);
    if (inside == 0 || inside == 4) return;
    // Even permutations bring the corners inside to the front.
    bool is_even = true;
    for (std::size_t first = 0; first < static_cast<std::size_t>(inside); ++first)
      for (std::size_t k = first; k < 4; ++k)
        if (is_inside(corners[k])) {
          if (k != first) {
            std::swap(corners[first], corners[k]);
            is_even = !is_even;
          }
          break;
        }
    const auto cut = [&](std::size_t a, std::size_t b) { return vertex(cell, values, corners[a], corners[b]); };
    if (inside == 1) return add_face(cut(0, 1), cut(0, 2), cut(0, 3), is_even);
    if (inside == 3) return add_face(cut(0, 3), cut(1, 3), cut(2, 3), is_even);
    const std::array<int, 4> ring{cut(0, 2), cut(0, 3), cut(1, 3), cut(1, 2)};
    add_face(ring[0], ring[1], ring[2], is_even);
    add_face(ring[0], ring[2], ring[3], is_even);
  }

  void add_face(int a, int b, int c, bool is_even) {
    mesh_.faces.push_back(is_even ? catalog::Triangle{a, b, c} : catalog::Triangle{a, c, b});
  }

  /// The vertex on the edge between two corners of a cell, of which one holds all the other's steps from corner 0; each
  /// edge is kept by its lower end and its direction (1 to 7).
  int vertex(const Cell& cell, const std::array<float, 8>& values, int a, int b) {
    const int low = std::min(a, b), high = std::max(a, b);
    std::vector<int>& layer = low >> 2 ? upper_ : lower_;
    int& known = layer[7 * grid_.index(cell[0] + (low & 1), cell[1] + (low >> 1 & 1), 0) +
                       static_cast<std::size_t>((high ^ low) - 1)];
    if (known >= 0) return known;
    const double from = values[static_cast<std::size_t>(low)], to = values[static_cast<std::size_t>(high)];
    const double share = from / (from - to);
    catalog::Point point;
    for (std::size_t i = 0; i < 3; ++i) {
      const int start = low >> i & 1, step = (high ^ low) >> i & 1;
      point[i] = (cell[i] + start + share * step) * grid_.spacing[i];
    }
    mesh_.vertices.push_back(point);
    known = static_cast<int>(mesh_.vertices.size()) - 1;
    return known;
  }

  const std::vector<float>& field_;
  const VoxelGrid& grid_;
  std::vector<int> lower_, upper_;  // vertices on the edges that begin in the two layers of the row of cells in work
  catalog::TriangleMesh mesh_;
};

}  // namespace

catalog::TriangleMesh level_surface(const std::vector<float>& field, const VoxelGrid& grid) {
  return Marching(field, grid).surface();
}

}  // namespace shape_pipeline
