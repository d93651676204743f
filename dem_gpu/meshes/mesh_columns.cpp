// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/meshes/mesh_columns.h"

#include <cmath>

#include "dem_gpu/meshes/contact_surface.h"
#include "dem_gpu/meshes/mesh_cells.h"
#include "dem_gpu/meshes/mesh_topology.h"

namespace dem_gpu {
namespace {

Real corner_angle(const catalog::TriangleMesh& mesh, std::size_t face, std::size_t corner) {
  const Vec3 a = face_corner(mesh, face, corner);
  const Vec3 u = face_corner(mesh, face, corner + 1) - a, v = face_corner(mesh, face, corner + 2) - a;
  return std::atan2(norm(cross(u, v)), dot(u, v));
}

/// Vertices with their normals (Thuermer & Wuethrich, J. Graphics Tools 3 (1998) 43-46) and fans.
void append_vertices(HostMeshColumns& columns, const catalog::TriangleMesh& surface,
                     const std::vector<int>& new_index) {
  const std::size_t base = columns.vertices.size();
  std::vector<std::vector<int>> fans(surface.vertices.size());
  std::vector<Vec3> normals(surface.vertices.size());
  const std::vector<Vec3> face_normal = face_normals(surface);
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(surface.faces[f][c]);
      fans[v].push_back(new_index[f]);
      normals[v] += corner_angle(surface, f, c) * face_normal[f];
    }
  columns.fan_first.resize(base + 1, static_cast<int>(columns.fan.size()));
  for (std::size_t v = 0; v < fans.size(); ++v) {
    columns.vertices.push_back(to_vec3(surface.vertices[v]));
    columns.vertex_normal.push_back(normals[v]);
    columns.fan.insert(columns.fan.end(), fans[v].begin(), fans[v].end());
    columns.fan_first.push_back(static_cast<int>(columns.fan.size()));
  }
}

MeshFacet facet_of(const catalog::Triangle& corners, const std::array<int, 3>& neighbours, int vertex_base,
                   const std::vector<int>& new_index) {
  MeshFacet facet;
  for (std::size_t c = 0; c < 3; ++c) {
    facet.corner[c] = vertex_base + corners[c];
    facet.neighbour[c] = new_index[static_cast<std::size_t>(neighbours[c])];
  }
  return facet;
}

}  // namespace

void append_mesh(HostMeshColumns& columns, const MeshObject& object, Real default_depth) {
  const catalog::TriangleMesh surface = contact_surface(object);
  const std::vector<MeshCell> cells = mesh_cells(surface, object.depth > 0 ? object.depth : default_depth);
  std::vector<Box> boxes;
  for (const MeshCell& cell : cells) boxes.push_back(cell.box);
  const BoxTree tree(boxes);
  const int facet_base = static_cast<int>(columns.facets.size());
  const int vertex_base = static_cast<int>(columns.vertices.size());
  std::vector<int> new_index(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    new_index[static_cast<std::size_t>(tree.order[i])] = facet_base + static_cast<int>(i);
  const auto neighbours = face_neighbours(surface);
  for (const int face : tree.order) {
    const auto f = static_cast<std::size_t>(face);
    MeshFacet facet = facet_of(surface.faces[f], neighbours[f], vertex_base, new_index);
    facet.first_plane = static_cast<int>(columns.planes.size());
    facet.plane_count = static_cast<int>(cells[f].planes.size());
    columns.planes.insert(columns.planes.end(), cells[f].planes.begin(), cells[f].planes.end());
    columns.facets.push_back(facet);
  }
  append_vertices(columns, surface, new_index);
  columns.meshes.push_back({static_cast<int>(columns.nodes.size()), static_cast<int>(tree.nodes.size())});
  for (BoxNode node : tree.nodes) {
    node.first += facet_base;
    columns.nodes.push_back(node);
  }
}

MeshColumns make_mesh_columns(const HostMeshColumns& host) {
  MeshColumns columns;
  assign(columns.meshes, host.meshes);
  assign(columns.facets, host.facets);
  assign(columns.planes, host.planes);
  assign(columns.vertices, host.vertices);
  assign(columns.vertex_normal, host.vertex_normal);
  assign(columns.fan_first, host.fan_first);
  assign(columns.fan, host.fan);
  assign(columns.nodes, host.nodes);
  return columns;
}

MeshView view(const MeshColumns& columns) {
  return {pointer(columns.meshes),   pointer(columns.facets),        pointer(columns.planes),
          pointer(columns.vertices), pointer(columns.vertex_normal), pointer(columns.fan_first),
          pointer(columns.fan),      pointer(columns.nodes)};
}

MeshView view(const HostMeshColumns& columns) {
  return {columns.meshes.data(),        columns.facets.data(),    columns.planes.data(), columns.vertices.data(),
          columns.vertex_normal.data(), columns.fan_first.data(), columns.fan.data(),    columns.nodes.data()};
}

}  // namespace dem_gpu
