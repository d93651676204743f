// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

inline Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }

/// Corner `c` (0, 1, 2; 3 is 0 again) of a face.
inline Vec3 face_corner(const catalog::TriangleMesh& mesh, std::size_t face, std::size_t c) {
  return to_vec3(mesh.vertices[static_cast<std::size_t>(mesh.faces[face][c % 3])]);
}

/// Twice the vector area of a face [m2].
inline Vec3 face_cross(const catalog::TriangleMesh& mesh, std::size_t face) {
  const Vec3 a = face_corner(mesh, face, 0);
  return cross(face_corner(mesh, face, 1) - a, face_corner(mesh, face, 2) - a);
}

/// Unit normal of each face, n_faces.
std::vector<Vec3> face_normals(const catalog::TriangleMesh& mesh);

/// Face across the edge from corner i to corner i + 1 of each face, -1 at a rim; n_faces x 3. Throws
/// catalog::InputError for an edge of three faces or two faces wound in opposite ways.
std::vector<std::array<int, 3>> face_neighbours(const catalog::TriangleMesh& mesh);

/// Refuses meshes without faces, indices and coordinates that are no such, faces without an area.
void refuse_bad_faces(const catalog::TriangleMesh& mesh);

/// Refuses a mesh whose faces pass through one another. Faces that only touch, or lie in one plane, are let pass.
void refuse_self_intersection(const catalog::TriangleMesh& mesh);

}  // namespace dem_gpu
