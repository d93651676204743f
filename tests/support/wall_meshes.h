// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <random>

#include "catalog/triangle_mesh.h"
#include "dem_gpu/scene.h"

namespace test_support {

/// Flat square sheet of edge `size` about the origin in z = 0, normals up, of 2 cells^2 triangles whose inner corners
/// are moved at random in the plane by up to a fifth of a cell.
inline catalog::TriangleMesh flat_sheet(double size, int cells, unsigned seed = 5) {
  catalog::TriangleMesh sheet;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      const bool is_rim = i == 0 || j == 0 || i == cells || j == cells;
      const double x = i + (is_rim ? 0 : shift(random)), y = j + (is_rim ? 0 : shift(random));
      sheet.vertices.push_back({size * (x / cells - 0.5), size * (y / cells - 0.5), 0});
    }
  const auto vertex = [&](int i, int j) { return i * (cells + 1) + j; };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      sheet.faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      sheet.faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return sheet;
}

/// One triangle that holds a circle of radius `size` about the origin in z = 0.
inline catalog::TriangleMesh one_triangle(double size) {
  return {{{-4 * size, -2 * size, 0}, {4 * size, -2 * size, 0}, {0, 4 * size, 0}}, {{0, 1, 2}}};
}

/// Closed drum about the y axis from y = 0 to `length`, its shell of flat segments; normals out of the drum.
inline catalog::TriangleMesh drum_mesh(double radius, double length, int segments) {
  catalog::TriangleMesh drum;
  for (const double y : {0.0, length})
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments;
      drum.vertices.push_back({radius * std::cos(angle), y, radius * std::sin(angle)});
    }
  drum.vertices.push_back({0, 0, 0});
  drum.vertices.push_back({0, length, 0});
  const int front = 2 * segments, back = front + 1;
  for (int i = 0; i < segments; ++i) {
    const int a = i, b = (i + 1) % segments, c = segments + i, d = segments + b;
    drum.faces.push_back({a, c, b});
    drum.faces.push_back({b, c, d});
    drum.faces.push_back({front, a, b});
    drum.faces.push_back({back, d, c});
  }
  return drum;
}

inline dem_gpu::Wall mesh_wall(const std::string& name, catalog::TriangleMesh mesh,
                               std::optional<double> thickness = std::nullopt) {
  dem_gpu::Wall wall;
  wall.name = name;
  wall.geometry = dem_gpu::MeshObject{std::move(mesh), thickness, false, 0};
  return wall;
}

}  // namespace test_support
