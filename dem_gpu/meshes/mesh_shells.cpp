// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/meshes/mesh_shells.h"

#include <cmath>
#include <numbers>

#include "dem_gpu/meshes/box_tree.h"
#include "dem_gpu/meshes/mesh_topology.h"

namespace dem_gpu {
namespace {

using catalog::TriangleMesh;

MeshShell shell_from(std::size_t face, const std::vector<std::array<int, 3>>& neighbours, std::vector<char>& is_taken) {
  MeshShell shell{{face}};
  is_taken[face] = 1;
  for (std::size_t next = 0; next < shell.faces.size(); ++next)
    for (const int other : neighbours[shell.faces[next]])
      if (other >= 0 && !is_taken[static_cast<std::size_t>(other)]) {
        is_taken[static_cast<std::size_t>(other)] = 1;
        shell.faces.push_back(static_cast<std::size_t>(other));
      }
  return shell;
}

double enclosed_volume(const TriangleMesh& mesh, const MeshShell& shell) {
  const Vec3 origin = face_corner(mesh, shell.faces[0], 0);
  double volume = 0;
  for (const std::size_t f : shell.faces)
    volume += dot(face_corner(mesh, f, 0) - origin,
                  cross(face_corner(mesh, f, 1) - origin, face_corner(mesh, f, 2) - origin)) /
              6;
  return volume;
}

Box box_of(const TriangleMesh& mesh, const MeshShell& shell) {
  Box box;
  for (const std::size_t f : shell.faces)
    for (std::size_t c = 0; c < 3; ++c) box.include(face_corner(mesh, f, c));
  return box;
}

/// By the solid angle of the shell as seen from the point: all round inside, nothing outside.
/// Van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125, eq. 8.
bool encloses(const TriangleMesh& mesh, const MeshShell& shell, const Vec3& point) {
  double angle = 0;
  for (const std::size_t f : shell.faces) {
    const Vec3 a = face_corner(mesh, f, 0) - point, b = face_corner(mesh, f, 1) - point,
               c = face_corner(mesh, f, 2) - point;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la);
  }
  return std::abs(angle) > 2 * std::numbers::pi;
}

}  // namespace

std::vector<MeshShell> mesh_shells(const TriangleMesh& mesh, const std::vector<std::array<int, 3>>& neighbours) {
  std::vector<MeshShell> shells;
  std::vector<Box> boxes;
  std::vector<char> is_taken(mesh.faces.size(), 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (is_taken[f]) continue;
    shells.push_back(shell_from(f, neighbours, is_taken));
    shells.back().volume = enclosed_volume(mesh, shells.back());
    boxes.push_back(box_of(mesh, shells.back()));
  }
  if (shells.size() == 1) return shells;
  const BoxTree tree(boxes);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const std::size_t f = shells[s].faces[0];
    const Vec3 point = (face_corner(mesh, f, 0) + face_corner(mesh, f, 1) + face_corner(mesh, f, 2)) / 3;
    Box at;
    at.include(point);
    tree.visit_overlapping(at, [&](int other) {
      if (static_cast<std::size_t>(other) != s)
        shells[s].shells_around += encloses(mesh, shells[static_cast<std::size_t>(other)], point);
      return true;
    });
  }
  return shells;
}

}  // namespace dem_gpu
