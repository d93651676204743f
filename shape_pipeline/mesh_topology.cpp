// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/mesh_topology.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "catalog/mass_properties.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

/// One side of a face; sorting brings the sides of an edge together.
struct FaceSide {
  int low, high;  // vertices of the edge
  int face;
  bool is_forward;  // the face runs from low to high

  bool same_edge(const FaceSide& other) const { return low == other.low && high == other.high; }
};

std::vector<FaceSide> sorted_face_sides(const catalog::TriangleMesh& mesh) {
  std::vector<FaceSide> sides;
  sides.reserve(3 * mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int c = 0; c < 3; ++c) {
      const int from = mesh.faces[f][c], to = mesh.faces[f][(c + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<int>(f), from < to});
    }
  std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  return sides;
}

/// Calls visit(first, last) for the range of sides of each edge.
template <class Visit>
void for_each_edge(const std::vector<FaceSide>& sides, const Visit& visit) {
  for (auto first = sides.begin(); first != sides.end();) {
    auto last = first;
    while (last != sides.end() && last->same_edge(*first)) ++last;
    visit(first, last);
    first = last;
  }
}

std::vector<int> components_of(const catalog::TriangleMesh& mesh, const std::vector<FaceSide>& sides) {
  std::vector<int> parent(mesh.faces.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int face) {
    while (parent[face] != face) face = parent[face] = parent[parent[face]];
    return face;
  };
  for_each_edge(sides, [&](auto first, auto last) {
    for (auto side = first + 1; side < last; ++side) {
      const int a = root(first->face), b = root(side->face);
      parent[std::max(a, b)] = std::min(a, b);
    }
  });
  std::vector<int> component(mesh.faces.size(), -1);
  int count = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const int r = root(static_cast<int>(f));
    component[f] = r == static_cast<int>(f) ? count++ : component[r];
  }
  return component;
}

double face_area(const catalog::TriangleMesh& mesh, const catalog::Triangle& face) {
  const Point& origin = mesh.vertices[face[0]];
  return norm(cross(subtract(mesh.vertices[face[1]], origin), subtract(mesh.vertices[face[2]], origin))) / 2;
}

}  // namespace

MeshTopology mesh_topology(const catalog::TriangleMesh& mesh) {
  const std::vector<FaceSide> sides = sorted_face_sides(mesh);
  MeshTopology topology;
  long edges = 0;
  for_each_edge(sides, [&](auto first, auto last) {
    ++edges;
    const auto count = last - first;
    if (count == 1) ++topology.boundary_edges;
    if (count > 2) ++topology.non_manifold_edges;
    if (count == 2 && first->is_forward == (first + 1)->is_forward) ++topology.misoriented_edges;
  });
  for (const int component : components_of(mesh, sides))
    topology.components = std::max<std::size_t>(topology.components, component + 1);
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const catalog::Triangle& face : mesh.faces)
    for (const int v : face) is_used[v] = true;
  topology.euler_number =
      std::count(is_used.begin(), is_used.end(), true) - edges + static_cast<long>(mesh.faces.size());
  return topology;
}

std::vector<int> face_components(const catalog::TriangleMesh& mesh) {
  return components_of(mesh, sorted_face_sides(mesh));
}

catalog::TriangleMesh submesh(const catalog::TriangleMesh& mesh, const std::vector<bool>& is_kept) {
  catalog::TriangleMesh result;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!is_kept[f]) continue;
    catalog::Triangle face = mesh.faces[f];
    for (int& v : face) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[v]);
      }
      v = number[v];
    }
    result.faces.push_back(face);
  }
  return result;
}

LargestSurface largest_surface(const catalog::TriangleMesh& mesh) {
  const std::vector<int> component = face_components(mesh);
  if (component.empty()) return {mesh, 0, 1};
  std::vector<double> area(*std::max_element(component.begin(), component.end()) + 1, 0);
  for (std::size_t f = 0; f < component.size(); ++f) area[component[f]] += face_area(mesh, mesh.faces[f]);
  const auto largest = std::max_element(area.begin(), area.end()) - area.begin();
  std::vector<bool> is_kept(component.size());
  for (std::size_t f = 0; f < component.size(); ++f) is_kept[f] = component[f] == largest;
  const double total = std::accumulate(area.begin(), area.end(), 0.0);
  return {submesh(mesh, is_kept), area.size() - 1, total > 0 ? area[largest] / total : 1};
}

double surface_area(const catalog::TriangleMesh& mesh) {
  double area = 0;
  for (const catalog::Triangle& face : mesh.faces) area += face_area(mesh, face);
  return area;
}

double signed_volume(const catalog::TriangleMesh& mesh) { return catalog::volume_moments(mesh).volume; }

double mean_edge_length(const catalog::TriangleMesh& mesh) {
  double sum = 0;
  std::size_t edges = 0;
  for_each_edge(sorted_face_sides(mesh), [&](auto first, auto) {
    sum += distance(mesh.vertices[first->low], mesh.vertices[first->high]);
    ++edges;
  });
  return edges > 0 ? sum / static_cast<double>(edges) : 0;
}

double bounding_diagonal(const std::vector<catalog::Point>& points) {
  if (points.empty()) return 0;
  Point low = points.front(), high = points.front();
  for (const Point& p : points)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  return distance(low, high);
}

}  // namespace shape_pipeline
