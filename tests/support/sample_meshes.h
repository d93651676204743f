// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "catalog/mass_properties.h"
#include "catalog/triangle_mesh.h"

namespace test_support {

/// Regular tetrahedron of edge `a` about the origin, outward.
inline catalog::TriangleMesh tetrahedron(double a) {
  const double h = a / (2 * std::numbers::sqrt2);
  return {{{h, h, h}, {h, -h, -h}, {-h, h, -h}, {-h, -h, h}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

/// Regular octahedron of edge `a` about the origin, outward.
inline catalog::TriangleMesh octahedron(double a) {
  const double r = a / std::numbers::sqrt2;
  return {{{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

/// Sphere of `rings` by 2 `rings` quadrilaterals cut in two, inscribed, outward.
inline catalog::TriangleMesh uv_sphere(double radius, int rings) {
  const int sectors = 2 * rings;
  catalog::TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, radius});
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double polar = std::numbers::pi * i / rings, azimuth = 2 * std::numbers::pi * j / sectors;
      mesh.vertices.push_back({radius * std::sin(polar) * std::cos(azimuth),
                               radius * std::sin(polar) * std::sin(azimuth), radius * std::cos(polar)});
    }
  mesh.vertices.push_back({0, 0, -radius});
  const int south = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * sectors + j % sectors; };
  for (int j = 0; j < sectors; ++j) {
    mesh.faces.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i < rings - 1; ++i) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.faces.push_back({at(rings - 1, j), south, at(rings - 1, j + 1)});
  }
  return mesh;
}

/// Torus about z of `n` by `n` quadrilaterals cut in two, outward; genus 1.
inline catalog::TriangleMesh torus(double ring_radius, double tube_radius, int n) {
  catalog::TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / n;
      const double r = ring_radius + tube_radius * std::cos(v);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v)});
    }
  const auto at = [&](int i, int j) { return (i % n) * n + j % n; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// The mesh turned by fixed skew angles, scaled, then shifted.
inline catalog::TriangleMesh moved(catalog::TriangleMesh mesh, double scale, const catalog::Point& shift) {
  const double a = 0.7, b = -1.1, c = 2.3;
  for (catalog::Point& p : mesh.vertices) {
    p = {p[0], p[1] * std::cos(a) - p[2] * std::sin(a), p[1] * std::sin(a) + p[2] * std::cos(a)};
    p = {p[0] * std::cos(b) + p[2] * std::sin(b), p[1], p[2] * std::cos(b) - p[0] * std::sin(b)};
    p = {p[0] * std::cos(c) - p[1] * std::sin(c), p[0] * std::sin(c) + p[1] * std::cos(c), p[2]};
    for (int i = 0; i < 3; ++i) p[i] = p[i] * scale + shift[i];
  }
  return mesh;
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace test_support
