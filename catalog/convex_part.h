// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace catalog {

/// Half-space boundary: points inside the part satisfy normal . x <= offset.
struct FacePlane {
  Point normal;   // unit, out of the part
  double offset;  // [m]
};

/// `outer` faces lie on the body's surface; `inner` faces are covered by a neighbouring part across a cut plane.
enum class FaceKind { outer, inner };

/// One planar convex polygon of a part's boundary.
struct ConvexFace {
  std::vector<int> vertices;  // polygon, counter-clockwise seen from outside, indices into ConvexPart::vertices
  FacePlane plane;  // inner faces of the two parts that meet at a cut carry the same plane, sign reversed, bit for bit
  FaceKind kind = FaceKind::outer;
};

/// Convex polyhedron: one part of a body. The parts of a body are a partition: they touch, they never overlap.
struct ConvexPart {
  std::vector<Point> vertices;    // n_vertices x 3 [m]
  std::vector<ConvexFace> faces;  // every face planar within the decomposition's tolerance

  std::size_t vertex_count() const { return vertices.size(); }
  std::size_t face_count() const { return faces.size(); }
};

/// The part's boundary as triangles (fans of its faces), outward normals.
inline TriangleMesh triangulated(const ConvexPart& part) {
  TriangleMesh mesh;
  mesh.vertices = part.vertices;
  for (const ConvexFace& face : part.faces)
    for (std::size_t corner = 2; corner < face.vertices.size(); ++corner)
      mesh.faces.push_back({face.vertices[0], face.vertices[corner - 1], face.vertices[corner]});
  return mesh;
}

}  // namespace catalog
