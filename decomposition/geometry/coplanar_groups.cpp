// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/geometry/coplanar_groups.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace decomposition {
namespace {

Vec3 area_vector(const std::vector<Vec3>& vertices, const std::array<int, 3>& face) {
  const auto at = [&](std::size_t k) { return vertices[static_cast<std::size_t>(face[k])]; };
  return 0.5 * cross(at(1) - at(0), at(2) - at(0));
}

}  // namespace

std::vector<std::array<int, 3>> face_neighbours(const std::vector<std::array<int, 3>>& faces) {
  struct Edge {
    int low, high, face, corner;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(faces[f][k], faces[f][(k + 1) % 3]);
      edges.push_back({low, high, static_cast<int>(f), static_cast<int>(k)});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  std::vector<std::array<int, 3>> neighbours(faces.size(), {-1, -1, -1});
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    const Edge &a = edges[e], &b = edges[e + 1];
    if (a.low != b.low || a.high != b.high) continue;
    neighbours[static_cast<std::size_t>(a.face)][static_cast<std::size_t>(a.corner)] = b.face;
    neighbours[static_cast<std::size_t>(b.face)][static_cast<std::size_t>(b.corner)] = a.face;
    ++e;
  }
  return neighbours;
}

CoplanarGroups coplanar_groups(const std::vector<Vec3>& vertices, const std::vector<std::array<int, 3>>& faces,
                               double tolerance, int most) {
  const std::vector<std::array<int, 3>> neighbours = face_neighbours(faces);
  std::vector<Vec3> area(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) area[f] = area_vector(vertices, faces[f]);
  std::vector<int> order(faces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return norm(area[static_cast<std::size_t>(a)]) > norm(area[static_cast<std::size_t>(b)]);
  });
  CoplanarGroups groups;
  groups.group_of.assign(faces.size(), -1);
  std::vector<int> front;
  for (const int seed : order) {
    const auto s = static_cast<std::size_t>(seed);
    if (groups.group_of[s] >= 0) continue;
    if (groups.count() > most) break;
    const double size = norm(area[s]);
    Plane plane{size > 0 ? (1 / size) * area[s] : Vec3{0, 0, 1}, 0};
    plane.offset = dot(plane.normal, vertices[static_cast<std::size_t>(faces[s][0])]);
    const int group = groups.count();
    groups.planes.push_back(plane);
    groups.areas.push_back(0);
    front.assign(1, seed);
    groups.group_of[s] = group;
    while (!front.empty()) {
      const auto f = static_cast<std::size_t>(front.back());
      front.pop_back();
      groups.areas.back() += norm(area[f]);
      for (const int next : neighbours[f]) {
        if (next < 0 || groups.group_of[static_cast<std::size_t>(next)] >= 0) continue;
        const auto n = static_cast<std::size_t>(next);
        const bool is_coplanar =
            dot(area[n], plane.normal) > -tolerance * std::sqrt(norm(area[n])) &&
            std::all_of(faces[n].begin(), faces[n].end(), [&](int v) {
              return std::abs(plane.signed_distance(vertices[static_cast<std::size_t>(v)])) <= tolerance;
            });
        if (!is_coplanar) continue;
        groups.group_of[n] = group;
        front.push_back(next);
      }
    }
  }
  return groups;
}

}  // namespace decomposition
