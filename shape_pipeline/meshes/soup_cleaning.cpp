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

/// Of two faces on the same vertices: whether one is the other begun elsewhere.
bool is_turned_alike(const catalog::Triangle& a, const catalog::Triangle& b) {
  const auto place = std::find(b.begin(), b.end(), a[0]) - b.begin();
  return b[static_cast<std::size_t>((place + 1) % 3)] == a[1];
}

/// Whether every edge is run along as often one way as the other.
bool is_balanced(const catalog::TriangleMesh& soup) {
  std::map<std::pair<int, int>, int> excess;
  for (const catalog::Triangle& face : soup.faces)
    for (std::size_t c = 0; c < 3; ++c) {
      const int from = face[c], to = face[(c + 1) % 3];
      excess[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
  return std::all_of(excess.begin(), excess.end(), [](const auto& edge) { return edge.second == 0; });
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

std::size_t remove_shared_walls(catalog::TriangleMesh& soup) {
  std::map<catalog::Triangle, std::vector<std::size_t>> sides;  // faces by their sorted vertices
  for (std::size_t f = 0; f < soup.faces.size(); ++f) {
    catalog::Triangle key = soup.faces[f];
    std::sort(key.begin(), key.end());
    sides[key].push_back(f);
  }
  std::vector<bool> is_wall(soup.faces.size(), false);
  std::size_t walls = 0;
  for (const auto& [key, faces] : sides) {
    if (faces.size() != 2 || is_turned_alike(soup.faces[faces[0]], soup.faces[faces[1]])) continue;
    is_wall[faces[0]] = is_wall[faces[1]] = true;
    walls += 2;
  }
  if (walls == 0 || walls == soup.faces.size() || !is_balanced(soup)) return 0;
  std::size_t f = 0;
  return std::erase_if(soup.faces, [&](const catalog::Triangle&) { return is_wall[f++]; });
}

std::size_t remove_duplicate_faces(catalog::TriangleMesh& soup) {
  std::set<catalog::Triangle> seen;
  return std::erase_if(soup.faces, [&](catalog::Triangle face) {
    std::sort(face.begin(), face.end());
    return !seen.insert(face).second;
  });
}

}  // namespace shape_pipeline
