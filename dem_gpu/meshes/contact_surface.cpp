// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/meshes/contact_surface.h"

#include <cmath>
#include <string>

#include "catalog/input_error.h"
#include "dem_gpu/meshes/mesh_shells.h"
#include "dem_gpu/meshes/mesh_topology.h"

namespace dem_gpu {
namespace {

using catalog::InputError;
using catalog::TriangleMesh;

/// Longest mitre of a sheet's back / its thickness: folds sharper than about 30 degrees are refused.
constexpr Real kLongestMitre = 4;
/// Cosine between two faces at an edge below which they count as folded flat onto each other.
constexpr Real kFolded = -0.9999;

void turn_round(TriangleMesh& mesh, const MeshShell& shell) {
  for (const std::size_t face : shell.faces) std::swap(mesh.faces[face][1], mesh.faces[face][2]);
}

/// Shells in turn bound the solid and a hole in it, from the outermost inwards; about a container all is solid.
void orient_container(TriangleMesh& mesh, const std::vector<MeshShell>& shells) {
  for (const MeshShell& shell : shells)
    if ((shell.volume > 0) == (shell.shells_around % 2 == 0)) turn_round(mesh, shell);
}

void refuse_inverted(const std::vector<MeshShell>& shells) {
  for (const MeshShell& shell : shells) {
    const bool is_cavity = shell.shells_around % 2 == 1;
    if (is_cavity ? shell.volume < 0 : shell.volume > 0) continue;
    const std::string whose =
        shells.size() == 1 ? "the mesh is inverted: its normals point"
                           : "the shell of triangle " + std::to_string(shell.faces[0]) + " (" +
                                 std::to_string(shell.faces.size()) + " of the mesh's triangles) is inverted: " +
                                 (is_cavity ? "it lies in another one, and its normals point" : "its normals point");
    if (is_cavity)
      throw InputError(whose + " into that one's solid; turn its triangles round if it is a cavity, or remove it");
    throw InputError(whose +
                     " into the solid; turn its triangles round, or state bodies = \"inside\" if it is a container");
  }
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
  }
  refuse_self_intersection(surface);
  if (object.thickness) return surface;
  const std::vector<MeshShell> shells = mesh_shells(surface, neighbours);
  if (object.is_container)
    orient_container(surface, shells);
  else
    refuse_inverted(shells);
  return surface;
}

}  // namespace dem_gpu
