// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "catalog/triangle_mesh.h"

/// Closed meshes with known volumes.
namespace solids {

using catalog::Point;
using catalog::TriangleMesh;

inline TriangleMesh box(const Point& low, const Point& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]});
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// All surfaces in one mesh, none joined.
inline TriangleMesh together(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) {
    const int first = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const catalog::Triangle& face : mesh.faces)
      all.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
  }
  return all;
}

inline TriangleMesh inside_out(TriangleMesh mesh) {
  for (catalog::Triangle& face : mesh.faces) std::swap(face[0], face[1]);
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, const Point& by) {
  for (Point& p : mesh.vertices)
    for (int i = 0; i < 3; ++i) p[i] += by[i];
  return mesh;
}

inline TriangleMesh scaled(TriangleMesh mesh, const Point& by) {
  for (Point& p : mesh.vertices)
    for (int i = 0; i < 3; ++i) p[i] *= by[i];
  return mesh;
}

inline TriangleMesh tetrahedron() {  // volume 1/6
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// Surface of a union of unit cells of a grid; `is_full(i, j, k)` says which. Each square face is cut into 2 n^2
/// triangles.
inline TriangleMesh voxels(int size, const std::function<bool(int, int, int)>& is_full, int n = 1) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, int> index;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [found, is_new] = index.try_emplace(p, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back({double(p[0]) / n, double(p[1]) / n, double(p[2]) / n});
    return found->second;
  };
  const auto full = [&](std::array<int, 3> c) {
    for (const int x : c)
      if (x < 0 || x >= size) return false;
    return is_full(c[0], c[1], c[2]);
  };
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j)
      for (int k = 0; k < size; ++k)
        for (int axis = 0; axis < 3; ++axis)
          for (int up = 0; up < 2; ++up) {
            std::array<int, 3> next{i, j, k};
            next[axis] += up ? 1 : -1;
            if (!full({i, j, k}) || full(next)) continue;
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (int a = 0; a < n; ++a)
              for (int b = 0; b < n; ++b) {
                std::array<int, 3> corner{i * n, j * n, k * n};
                corner[axis] += up * n;
                corner[u] += a;
                corner[v] += b;
                std::array<int, 3> cu = corner, cuv = corner, cv = corner;
                ++cu[u], ++cuv[u], ++cuv[v], ++cv[v];
                const int p = vertex(corner), q = vertex(cu), r = vertex(cuv), s = vertex(cv);
                if (up) {
                  mesh.faces.push_back({p, q, r});
                  mesh.faces.push_back({p, r, s});
                } else {
                  mesh.faces.push_back({p, r, q});
                  mesh.faces.push_back({p, s, r});
                }
              }
          }
  return mesh;
}

inline TriangleMesh l_shape() {  // volume 3, two boxes
  return voxels(2, [](int i, int j, int k) { return k == 0 && !(i == 1 && j == 1); });
}

inline TriangleMesh flat_cross() {  // volume 5, three boxes
  return voxels(3, [](int i, int j, int k) { return k == 0 && (i == 1 || j == 1); });
}

/// A sphere-like mesh of radius radius(direction), from an octahedron whose faces are cut into 4^levels.
inline TriangleMesh star(const std::function<double(const Point&)>& radius, int levels) {
  TriangleMesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto between = [&](int a, int b) {
      const auto [found, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (is_new) {
        Point p;
        double length = 0;
        for (int i = 0; i < 3; ++i) {
          p[i] = mesh.vertices[a][i] + mesh.vertices[b][i];
          length += p[i] * p[i];
        }
        for (double& x : p) x /= std::sqrt(length);
        mesh.vertices.push_back(p);
      }
      return found->second;
    };
    std::vector<catalog::Triangle> finer;
    for (const auto& [a, b, c] : mesh.faces) {
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.faces = std::move(finer);
  }
  for (Point& p : mesh.vertices) {
    const double r = radius(p);
    for (double& x : p) x *= r;
  }
  return mesh;
}

inline TriangleMesh sphere(double radius, int levels) {
  return star([radius](const Point&) { return radius; }, levels);
}

/// Torus of n x m quads, axis z.
inline TriangleMesh torus(double big, double small, int n, int m) {
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / m;
      const double r = big + small * std::cos(b);
      mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), small * std::sin(b)});
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const int i1 = (i + 1) % n, j1 = (j + 1) % m;
      const int p = i * m + j, q = i1 * m + j, r = i1 * m + j1, s = i * m + j1;
      mesh.faces.push_back({p, q, r});
      mesh.faces.push_back({p, r, s});
    }
  return mesh;
}

}  // namespace solids
