// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/meshes/mesh_cells.h"

#include <algorithm>
#include <cmath>

#include "dem_gpu/meshes/mesh_columns.h"
#include "dem_gpu/meshes/mesh_topology.h"

namespace dem_gpu {
namespace {

using catalog::TriangleMesh;
using Neighbours = std::vector<std::array<int, 3>>;

/// Lengths below this share of a cell's depth count as none: far above rounding, far below what a contact notices.
constexpr Real kLeastShare = 1e-7;
/// Normals closer than this are those of one plane.
constexpr Real kSameNormal = 1e-9;
/// Where more cells meet than planes fit, as under the middle of a ball, layers are made thinner by this factor.
constexpr Real kThinner = Real(0.8);

HalfSpace unit_half_space(const Vec3& normal, const Vec3& point) {
  const Vec3 n = normal / norm(normal);
  return {n, dot(n, point)};
}

struct Surface {
  const TriangleMesh& mesh;
  std::vector<Vec3> normals;
  Neighbours neighbours;
  BoxTree tree;  // of the faces

  explicit Surface(const TriangleMesh& closed)
      : mesh(closed), normals(face_normals(closed)), neighbours(face_neighbours(closed)), tree(face_boxes(closed)) {}

  static std::vector<Box> face_boxes(const TriangleMesh& mesh) {
    std::vector<Box> boxes(mesh.faces.size());
    for (std::size_t f = 0; f < boxes.size(); ++f)
      for (std::size_t c = 0; c < 3; ++c) boxes[f].include(face_corner(mesh, f, c));
    return boxes;
  }
  HalfSpace plane(std::size_t face) const { return {normals[face], dot(normals[face], face_corner(mesh, face, 0))}; }
  bool shares_edge(std::size_t face, int other) const {
    const auto& three = neighbours[face];
    return std::find(three.begin(), three.end(), other) != three.end();
  }
  bool shares_vertex(std::size_t face, std::size_t other) const {
    for (const int a : mesh.faces[face])
      for (const int b : mesh.faces[other])
        if (a == b) return true;
    return false;
  }
  /// Do all corners of `face` lie behind the plane, or in it?
  bool lies_behind(std::size_t face, const HalfSpace& plane, Real tolerance) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (depth_below(plane, face_corner(mesh, face, c)) < -tolerance) return false;
    return true;
  }
};

/// Half the way from the middle of a face through the solid, or `depth` if that is less.
Real half_thickness(const Surface& surface, std::size_t face, Real depth) {
  const Vec3 normal = surface.normals[face];
  const Vec3 start =
      (face_corner(surface.mesh, face, 0) + face_corner(surface.mesh, face, 1) + face_corner(surface.mesh, face, 2)) /
      3;
  Box path;
  path.include(start);
  path.include(start - 2 * depth * normal);
  Real least = depth;
  surface.tree.visit_overlapping(path, [&](int index) {
    const auto other = static_cast<std::size_t>(index);
    const Real falling = dot(surface.normals[other], normal);
    if (falling >= 0 || surface.shares_vertex(face, other)) return true;
    const HalfSpace plane = surface.plane(other);
    const Real travel = depth_below(plane, start) / -falling;
    if (travel <= 0 || travel >= 2 * least) return true;
    const Vec3 exit = start - travel * normal;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 corner = face_corner(surface.mesh, other, c);
      if (dot(cross(face_corner(surface.mesh, other, c + 1) - corner, exit - corner), plane.normal) < 0) return true;
    }
    least = travel / 2;
    return true;
  });
  return least;
}

/// Own plane, bottom, the bisector at each edge; at re-entrant edges sharper than a right angle the cell also ends
/// where it has gone as far beyond the edge as it is deep.
std::vector<HalfSpace> edge_planes(const Surface& surface, std::size_t face, Real depth) {
  const Vec3 normal = surface.normals[face];
  std::vector<HalfSpace> planes{surface.plane(face)};
  planes.push_back({-normal, depth - planes[0].offset});
  for (std::size_t c = 0; c < 3; ++c) {
    const int from = surface.mesh.faces[face][c], to = surface.mesh.faces[face][(c + 1) % 3];
    const Vec3 edge = face_corner(surface.mesh, face, c + 1) - face_corner(surface.mesh, face, c);
    const Vec3 other = surface.normals[static_cast<std::size_t>(surface.neighbours[face][c])];
    // Both faces take the plane through the same vertex: its two sides then fit to the last bit.
    const Vec3 shared = to_vec3(surface.mesh.vertices[static_cast<std::size_t>(std::min(from, to))]);
    planes.push_back(unit_half_space(cross(edge, normal + other), shared));
    const Vec3 outward = cross(edge, normal) / norm(edge);
    const bool is_reentrant = dot(outward, other) < 0;
    if (is_reentrant && dot(normal, other) < 0) planes.push_back({outward, dot(outward, shared) + depth});
  }
  return planes;
}

/// Meets of three planes that lie inside all the others: the corners of a bounded cell.
std::vector<Vec3> cell_corners(const std::vector<HalfSpace>& planes, Real tolerance) {
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const Vec3 line = cross(planes[i].normal, planes[j].normal);
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        const Real determinant = dot(line, planes[k].normal);
        if (std::abs(determinant) < kSameNormal) continue;
        const Vec3 x = (planes[i].offset * cross(planes[j].normal, planes[k].normal) +
                        planes[j].offset * cross(planes[k].normal, planes[i].normal) + planes[k].offset * line) /
                       determinant;
        if (std::all_of(planes.begin(), planes.end(),
                        [&](const HalfSpace& plane) { return depth_below(plane, x) >= -tolerance; }))
          corners.push_back(x);
      }
    }
  return corners;
}

struct DraftCell {
  MeshCell cell;
  std::vector<Vec3> corners;
  Real depth = 0;
};

bool is_separated(const DraftCell& a, const DraftCell& b, Real tolerance) {
  const auto all_outside = [&](const DraftCell& cell, const DraftCell& other) {
    return std::any_of(cell.cell.planes.begin(), cell.cell.planes.end(), [&](const HalfSpace& plane) {
      return std::all_of(other.corners.begin(), other.corners.end(),
                         [&](const Vec3& x) { return depth_below(plane, x) <= tolerance; });
    });
  };
  return all_outside(a, b) || all_outside(b, a);
}

class CellBuilder {
 public:
  CellBuilder(const TriangleMesh& mesh, Real depth) : surface_(mesh), drafts_(mesh.faces.size()) {
    for (std::size_t f = 0; f < drafts_.size(); ++f) draft(f, half_thickness(surface_, f, depth));
  }

  std::vector<MeshCell> cells() {
    std::vector<std::vector<HalfSpace>> bisectors;
    while (!find_bisectors(bisectors)) {
    }
    std::vector<MeshCell> result;
    for (std::size_t f = 0; f < drafts_.size(); ++f) {
      result.push_back(std::move(drafts_[f].cell));
      result.back().planes.insert(result.back().planes.end(), bisectors[f].begin(), bisectors[f].end());
    }
    return result;
  }

 private:
  void draft(std::size_t face, Real depth) {
    DraftCell& draft = drafts_[face];
    draft.depth = depth;
    draft.cell.planes = edge_planes(surface_, face, depth);
    draft.corners = cell_corners(draft.cell.planes, kLeastShare * depth);
    draft.cell.box = {};
    for (const Vec3& corner : draft.corners) draft.cell.box.include(corner);
    for (std::size_t c = 0; c < 3; ++c) draft.cell.box.include(face_corner(surface_.mesh, face, c));
  }

  /// Bisectors against the cells that a cell runs into, each plane once. False if there were too many somewhere: those
  /// cells have been made thinner.
  bool find_bisectors(std::vector<std::vector<HalfSpace>>& bisectors) {
    std::vector<Box> boxes;
    for (const DraftCell& draft : drafts_) boxes.push_back(draft.cell.box);
    const BoxTree tree(boxes);
    bisectors.assign(drafts_.size(), {});
    std::vector<std::size_t> crowded;
    for (std::size_t f = 0; f < drafts_.size(); ++f) {
      const std::size_t room = kMaxCellPlanes - drafts_[f].cell.planes.size();
      tree.visit_overlapping(boxes[f], [&](int other) {
        add_bisector(f, static_cast<std::size_t>(other), bisectors[f]);
        return bisectors[f].size() <= room;
      });
      if (bisectors[f].size() > room) crowded.push_back(f);
    }
    for (const std::size_t f : crowded) draft(f, kThinner * drafts_[f].depth);
    return crowded.empty();
  }

  void add_bisector(std::size_t face, std::size_t other, std::vector<HalfSpace>& bisectors) const {
    if (face == other || surface_.shares_edge(face, static_cast<int>(other))) return;
    const HalfSpace own = surface_.plane(face), opposite = surface_.plane(other);
    const Vec3 difference = opposite.normal - own.normal;
    const Real length = norm(difference);
    const Real tolerance = kLeastShare * std::min(drafts_[face].depth, drafts_[other].depth);
    // Only faces of which each lies behind the other's plane: elsewhere the nearer plane is not the nearer face.
    if (length < kSameNormal || !surface_.lies_behind(face, opposite, tolerance) ||
        !surface_.lies_behind(other, own, tolerance) || is_separated(drafts_[face], drafts_[other], tolerance))
      return;
    const HalfSpace bisector{difference / length, (opposite.offset - own.offset) / length};
    const bool is_known = std::any_of(bisectors.begin(), bisectors.end(), [&](const HalfSpace& known) {
      return norm(known.normal - bisector.normal) < kSameNormal && std::abs(known.offset - bisector.offset) < tolerance;
    });
    if (!is_known) bisectors.push_back(bisector);
  }

  Surface surface_;
  std::vector<DraftCell> drafts_;
};

}  // namespace

std::vector<MeshCell> mesh_cells(const TriangleMesh& surface, Real depth) {
  return CellBuilder(surface, depth).cells();
}

}  // namespace dem_gpu
