// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Counts that tell whether a mesh bounds one solid.
struct MeshTopology {
  std::size_t boundary_edges = 0;      // edges with one face
  std::size_t non_manifold_edges = 0;  // edges with three faces or more
  std::size_t misoriented_edges = 0;   // edges whose two faces run along them in the same direction
  std::size_t components = 0;          // face sets connected by edges
  long euler_number = 0;               // vertices in use - edges + faces; 2 - 2 genus for one closed surface

  bool is_closed() const { return boundary_edges == 0 && non_manifold_edges == 0 && misoriented_edges == 0; }
};

MeshTopology mesh_topology(const catalog::TriangleMesh& mesh);

/// Component number of each face (n_faces), counted from 0 in the order of first appearance; faces hang together by
/// shared edges.
std::vector<int> face_components(const catalog::TriangleMesh& mesh);

/// The faces with the given marks (n_faces), with the vertices that they use.
catalog::TriangleMesh submesh(const catalog::TriangleMesh& mesh, const std::vector<bool>& is_kept);

struct LargestSurface {
  catalog::TriangleMesh mesh;
  std::size_t dropped = 0;  // other components
  double area_share = 1;    // of the kept component in the whole
};

/// The component of largest area.
LargestSurface largest_surface(const catalog::TriangleMesh& mesh);

double surface_area(const catalog::TriangleMesh& mesh);      // [m2]
double signed_volume(const catalog::TriangleMesh& mesh);     // [m3], positive for a closed mesh turned outwards
double mean_edge_length(const catalog::TriangleMesh& mesh);  // [m], each edge once
double bounding_diagonal(const std::vector<catalog::Point>& points);  // of the box along the axes [m]

}  // namespace shape_pipeline
