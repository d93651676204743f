// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/growth/grid_mesh.h"

#include <algorithm>

namespace workflows {
namespace {

catalog::TriangleMesh grid(double low, double high, int cells) {
  catalog::TriangleMesh mesh;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column)
      mesh.vertices.push_back({low + (high - low) * column / cells, low + (high - low) * row / cells, 0});
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const int corner = row * (cells + 1) + column, above = corner + cells + 1;
      mesh.faces.push_back({corner, corner + 1, above + 1});
      mesh.faces.push_back({corner, above + 1, above});
    }
  return mesh;
}

}  // namespace

void make_floor_a_mesh(dem_gpu::Scene& scene, int cells) {
  constexpr double kBeyond = 0.01, kThickness = 0.02;  // [m]
  double width = 0;
  for (const dem_gpu::Wall& wall : scene.walls)
    if (const auto* plane = std::get_if<dem_gpu::Plane>(&wall.geometry)) width = std::max(width, plane->point.x);
  for (dem_gpu::Wall& wall : scene.walls)
    if (wall.name == "floor") wall.geometry = dem_gpu::MeshObject{grid(-kBeyond, width + kBeyond, cells), kThickness};
}

}  // namespace workflows
