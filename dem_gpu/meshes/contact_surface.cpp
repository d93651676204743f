// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/meshes/contact_surface.h"

#include <cmath>

#include "catalog/input_error.h"
#include "dem_gpu/meshes/mesh_topology.h"

namespace dem_gpu {
namespace {

using catalog::InputError;
using catalog::TriangleMesh;

/// Longest mitre of a sheet's back / its thickness: folds sharper than about 30 degrees are refused.
constexpr Real kLongestMitre = 4;
/// Cosine between two faces at an edge below which they count as folded flat onto each other.
constexpr Real kFolded = -0.9999;

double enclosed_volume(const TriangleMesh& mesh) {
  const Vec3 origin = face_corner(mesh, 0, 0);
  double volume = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    volume += dot(face_corner(mesh, f, 0) - origin,
                  cross(face_corner(mesh, f, 1) - origin, face_corner(mesh, f, 2) - origin)) /
              6;
  return volume;
}

void turn_round(TriangleMesh& mesh) {
  for (catalog::Triangle& face : mesh.faces) std::swap(face[1], face[2]);
}

/// Solves the symmetric system m x = b by Cramer's rule.
Vec3 solve(const Mat3& m, const Vec3& b) {
  const Real determinant = dot(m.column_x, cross(m.column_y, m.column_z));
  return Vec3{dot(b, cross(m.column_y, m.column_z)), dot(m.column_x, cross(b, m.column_z)),
              dot(m.column_x, cross(m.column_y, b))} /
         determinant;
}

/// From each vertex to the meet of its faces' planes moved forward by 1, in the least-squares sense: the mitre.
std::vector<Vec3> mitres(const TriangleMesh& mesh) {
  // Keeps flat fans solvable; moves the meet by this share.
  constexpr Real kRegular = 1e-9;
  const std::vector<Vec3> normals = face_normals(mesh);
  std::vector<Mat3> squares(mesh.vertices.size(), Mat3{{kRegular, 0, 0}, {0, kRegular, 0}, {0, 0, kRegular}});
  std::vector<Vec3> sums(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const int v : mesh.faces[f]) {
      const Vec3& n = normals[f];
      Mat3& square = squares[static_cast<std::size_t>(v)];
      square.column_x += n.x * n;
      square.column_y += n.y * n;
      square.column_z += n.z * n;
      sums[static_cast<std::size_t>(v)] += n;
    }
  std::vector<Vec3> result;
  for (std::size_t v = 0; v < sums.size(); ++v) {
    result.push_back(norm_squared(sums[v]) > 0 ? solve(squares[v], sums[v]) : Vec3{});
    if (!(norm(result.back()) < kLongestMitre))
      throw InputError("the sheet is folded too sharply at vertex " + std::to_string(v) +
                       " for a thickness; model it as a closed solid");
  }
  return result;
}

/// Front, back at `thickness` behind it, and a rim.
TriangleMesh thickened(const TriangleMesh& sheet, const std::vector<std::array<int, 3>>& neighbours, Real thickness) {
  TriangleMesh solid = sheet;
  const std::vector<Vec3> mitre = mitres(sheet);
  const int count = static_cast<int>(sheet.vertices.size());
  for (std::size_t v = 0; v < sheet.vertices.size(); ++v) {
    const Vec3 back = to_vec3(sheet.vertices[v]) - thickness * mitre[v];
    solid.vertices.push_back({back.x, back.y, back.z});
  }
  for (const auto& [a, b, c] : sheet.faces) {
    solid.faces.push_back({count + a, count + c, count + b});
    if (!(dot(face_cross(solid, solid.faces.size() - 1),
              face_cross(solid, solid.faces.size() - 1 - sheet.faces.size())) < 0))
      throw InputError("the thickness is larger than the sheet's radius of curvature at triangle " +
                       std::to_string(solid.faces.size() - 1 - sheet.faces.size()) + "; make it thinner");
  }
  for (std::size_t f = 0; f < sheet.faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      if (neighbours[f][c] >= 0) continue;
      const int a = sheet.faces[f][c], b = sheet.faces[f][(c + 1) % 3];
      solid.faces.push_back({b, a, count + a});
      solid.faces.push_back({b, count + a, count + b});
    }
  return solid;
}

void refuse_folds(const TriangleMesh& mesh, const std::vector<std::array<int, 3>>& neighbours) {
  const std::vector<Vec3> normals = face_normals(mesh);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const int other : neighbours[f])
      if (other >= 0 && dot(normals[f], normals[static_cast<std::size_t>(other)]) < kFolded)
        throw InputError("triangles " + std::to_string(f) + " and " + std::to_string(other) +
                         " are folded flat onto each other; remove one, or open the fold");
}

}  // namespace

TriangleMesh contact_surface(const MeshObject& object) {
  refuse_bad_faces(object.mesh);
  const auto neighbours = face_neighbours(object.mesh);
  refuse_folds(object.mesh, neighbours);
  bool is_open = false;
  for (const auto& three : neighbours)
    for (const int other : three) is_open = is_open || other < 0;
  TriangleMesh surface = object.mesh;
  if (object.thickness) {
    if (!(*object.thickness > 0) || !std::isfinite(*object.thickness))
      throw InputError("thickness must be more than 0");
    if (object.is_container) throw InputError("a container is solid all about it; leave thickness or container out");
    surface = thickened(object.mesh, neighbours, *object.thickness);
  } else if (is_open) {
    throw InputError(
        "the mesh is open, so it encloses no solid; give the sheet a thickness (solid behind its triangles), or close "
        "it");
  } else if (object.is_container) {
    if (enclosed_volume(surface) > 0) turn_round(surface);
  } else if (!(enclosed_volume(surface) > 0)) {
    throw InputError(
        "the mesh is inverted: its normals point into the solid; turn its triangles round, or state bodies = "
        "\"inside\" if it is a container");
  }
  refuse_self_intersection(surface);
  return surface;
}

}  // namespace dem_gpu
