// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Copies an indexed mesh into a half-edge mesh. Returns false if a face does not fit (non-manifold or flipped edge).
template <class SurfaceMesh>
bool copy_to_surface_mesh(const catalog::TriangleMesh& mesh, SurfaceMesh& result) {
  using Vertex = typename SurfaceMesh::Vertex_index;
  std::vector<Vertex> vertex;
  vertex.reserve(mesh.vertices.size());
  for (const catalog::Point& p : mesh.vertices)
    vertex.push_back(result.add_vertex(typename SurfaceMesh::Point(p[0], p[1], p[2])));
  for (const catalog::Triangle& face : mesh.faces)
    if (result.add_face(vertex[face[0]], vertex[face[1]], vertex[face[2]]) == SurfaceMesh::null_face()) return false;
  return true;
}

/// Copies a triangulated half-edge mesh into an indexed mesh; vertices without faces are left out.
template <class SurfaceMesh>
catalog::TriangleMesh copy_from_surface_mesh(const SurfaceMesh& mesh) {
  catalog::TriangleMesh result;
  std::vector<int> number(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const auto face : mesh.faces()) {
    catalog::Triangle corners{};
    int corner = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face))) {
      int& index = number[vertex.idx()];
      if (index < 0) {
        index = static_cast<int>(result.vertices.size());
        const auto& p = mesh.point(vertex);
        result.vertices.push_back({p.x(), p.y(), p.z()});
      }
      if (corner < 3) corners[corner++] = index;
    }
    result.faces.push_back(corners);
  }
  return result;
}

}  // namespace shape_pipeline
