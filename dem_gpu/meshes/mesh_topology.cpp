// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/meshes/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "catalog/input_error.h"
#include "dem_gpu/meshes/box_tree.h"

namespace dem_gpu {
namespace {

using catalog::InputError;
using catalog::TriangleMesh;

/// Twice a face's area over its longest edge squared, below which its normal says nothing.
constexpr Real kFlatness = 1e-10;
/// Shares of an edge and of a triangle within which a crossing counts as touching.
constexpr Real kTouching = 1e-7;

std::string triangle_name(std::size_t face) { return "triangle " + std::to_string(face); }

bool shares_vertex(const TriangleMesh& mesh, std::size_t face, int vertex) {
  const catalog::Triangle& corners = mesh.faces[face];
  return std::find(corners.begin(), corners.end(), vertex) != corners.end();
}

/// Does the segment from a to b pass through the inside of a face?
bool pierces(const TriangleMesh& mesh, const Vec3& a, const Vec3& b, std::size_t face) {
  const Vec3 area = face_cross(mesh, face), corner = face_corner(mesh, face, 0);
  const Real from = dot(area, a - corner), to = dot(area, b - corner);
  const Real margin = kTouching * norm(area) * norm(b - a);
  if (!((from > margin && to < -margin) || (from < -margin && to > margin))) return false;
  const Vec3 x = a + (from / (from - to)) * (b - a);
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 start = face_corner(mesh, face, c);
    if (dot(cross(face_corner(mesh, face, c + 1) - start, x - start), area) <= kTouching * norm_squared(area))
      return false;
  }
  return true;
}

/// Does an edge of `face` pass through `other`? Edges that end in a corner of `other` do not count.
bool cuts(const TriangleMesh& mesh, std::size_t face, std::size_t other) {
  for (std::size_t c = 0; c < 3; ++c) {
    const int from = mesh.faces[face][c], to = mesh.faces[face][(c + 1) % 3];
    if (shares_vertex(mesh, other, from) || shares_vertex(mesh, other, to)) continue;
    if (pierces(mesh, face_corner(mesh, face, c), face_corner(mesh, face, c + 1), other)) return true;
  }
  return false;
}

}  // namespace

std::vector<Vec3> face_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 area = face_cross(mesh, f);
    normals.push_back(area / norm(area));
  }
  return normals;
}

std::vector<std::array<int, 3>> face_neighbours(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, std::size_t> face_of_edge;  // directed
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [found, is_new] = face_of_edge.try_emplace({mesh.faces[f][c], mesh.faces[f][(c + 1) % 3]}, f);
      if (!is_new)
        throw InputError(triangle_name(found->second) + " and " + triangle_name(f) +
                         " share an edge but are wound in opposite ways, or a third one shares it; orient the mesh so "
                         "that all normals point out of the solid, each edge between two triangles");
    }
  std::vector<std::array<int, 3>> neighbours(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto found = face_of_edge.find({mesh.faces[f][(c + 1) % 3], mesh.faces[f][c]});
      neighbours[f][c] = found == face_of_edge.end() ? -1 : static_cast<int>(found->second);
    }
  return neighbours;
}

void refuse_bad_faces(const TriangleMesh& mesh) {
  if (mesh.faces.empty()) throw InputError("the mesh has no triangles");
  for (const catalog::Point& p : mesh.vertices)
    if (!(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])))
      throw InputError("the mesh has a vertex that is not finite");
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const int vertex : mesh.faces[f])
      if (vertex < 0 || vertex >= static_cast<int>(mesh.vertices.size()))
        throw InputError(triangle_name(f) + " names a vertex that is not there");
    Real longest = 0;
    for (std::size_t c = 0; c < 3; ++c)
      longest = std::max(longest, norm_squared(face_corner(mesh, f, c + 1) - face_corner(mesh, f, c)));
    if (!(norm(face_cross(mesh, f)) > kFlatness * longest))
      throw InputError(triangle_name(f) + " has no area; remove degenerate triangles (merge close vertices)");
  }
}

void refuse_self_intersection(const TriangleMesh& mesh) {
  std::vector<Box> boxes(mesh.faces.size());
  for (std::size_t f = 0; f < boxes.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c) boxes[f].include(face_corner(mesh, f, c));
  const BoxTree tree(boxes);
  for (std::size_t f = 0; f < boxes.size(); ++f)
    tree.visit_overlapping(boxes[f], [&](int other) {
      if (static_cast<std::size_t>(other) != f && cuts(mesh, f, static_cast<std::size_t>(other)))
        throw InputError("triangles " + std::to_string(f) + " and " + std::to_string(other) +
                         " pass through each other; repair the mesh, or split it into walls that overlap");
      return true;
    });
}

}  // namespace dem_gpu
