// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/soup_cleaning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

/// New index of each vertex when vertices with equal keys become one, numbered by first appearance.
template <class Key>
std::vector<int> numbers_by_key(const std::vector<Key>& keys) {
  std::map<Key, int> first;
  std::vector<int> number(keys.size());
  for (std::size_t v = 0; v < keys.size(); ++v)
    number[v] = first.try_emplace(keys[v], static_cast<int>(first.size())).first->second;
  return number;
}

/// Pairs of vertices within the tolerance, found in cells of that width, joined transitively.
std::vector<int> numbers_by_distance(const std::vector<Point>& points, double tolerance) {
  using Cell = std::array<long long, 3>;
  const auto cell_of = [&](const Point& p) {
    Cell cell;
    for (int i = 0; i < 3; ++i) cell[i] = static_cast<long long>(std::floor(p[i] / tolerance));
    return cell;
  };
  std::map<Cell, std::vector<int>> cells;
  std::vector<int> representative(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Cell centre = cell_of(points[v]);
    int found = -1;
    for (int code = 0; code < 27 && found < 0; ++code) {
      const auto entry = cells.find({centre[0] + code % 3 - 1, centre[1] + code / 3 % 3 - 1, centre[2] + code / 9 - 1});
      if (entry == cells.end()) continue;
      for (const int other : entry->second)
        if (distance(points[other], points[v]) <= tolerance) {
          found = other;
          break;
        }
    }
    representative[v] = found >= 0 ? found : static_cast<int>(v);
    if (found < 0) cells[centre].push_back(static_cast<int>(v));
  }
  return numbers_by_key(representative);
}

}  // namespace

std::size_t weld_vertices(catalog::TriangleMesh& soup, double tolerance) {
  const std::vector<int> number =
      tolerance > 0 ? numbers_by_distance(soup.vertices, tolerance) : numbers_by_key(soup.vertices);
  std::vector<Point> vertices;
  for (std::size_t v = 0; v < soup.vertices.size(); ++v)
    if (number[v] == static_cast<int>(vertices.size())) vertices.push_back(soup.vertices[v]);
  const std::size_t joined = soup.vertices.size() - vertices.size();
  soup.vertices = std::move(vertices);
  for (catalog::Triangle& face : soup.faces)
    for (int& v : face) v = number[v];
  return joined;
}

void put_in_canonical_order(catalog::TriangleMesh& mesh) {
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const catalog::Triangle& face : mesh.faces)
    for (const int v : face) is_used[v] = true;
  std::vector<int> order;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (is_used[v]) order.push_back(static_cast<int>(v));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return mesh.vertices[a] < mesh.vertices[b]; });
  std::vector<int> number(mesh.vertices.size(), -1);
  std::vector<Point> vertices;
  for (const int v : order) {
    number[v] = static_cast<int>(vertices.size());
    vertices.push_back(mesh.vertices[v]);
  }
  mesh.vertices = std::move(vertices);
  for (catalog::Triangle& face : mesh.faces) {
    for (int& v : face) v = number[v];
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  }
  std::sort(mesh.faces.begin(), mesh.faces.end());
}

std::size_t remove_degenerate_faces(catalog::TriangleMesh& soup) {
  return std::erase_if(soup.faces, [&](const catalog::Triangle& face) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) return true;
    const Point& origin = soup.vertices[face[0]];
    return norm(cross(subtract(soup.vertices[face[1]], origin), subtract(soup.vertices[face[2]], origin))) == 0;
  });
}

std::size_t remove_duplicate_faces(catalog::TriangleMesh& soup) {
  std::set<catalog::Triangle> seen;
  return std::erase_if(soup.faces, [&](catalog::Triangle face) {
    std::sort(face.begin(), face.end());
    return !seen.insert(face).second;
  });
}

}  // namespace shape_pipeline
