// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/walls/hidden_faces.h"

#include <algorithm>
#include <cmath>

#include "dem_gpu/walls/wall_columns.h"
#include "dem_gpu/walls/wall_surface.h"

namespace dem_gpu {
namespace {

/// Share of the object's size by which a face may stand out of the wall that hides it: rounding of scene files.
constexpr Real kFlush = 1e-6;

Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }

/// Depth of a point in a wall at time 0, by its planes or its field; minus infinity where it says nothing. [m]
Real depth_in(const Wall& wall, const WallRecord& record, const Vec3& x) {
  if (std::holds_alternative<MeshObject>(wall.geometry)) return -HUGE_VAL;
  if (const auto* object = std::get_if<VolumeObject>(&wall.geometry)) {
    Real depth = HUGE_VAL;
    for (const catalog::ConvexFace& face : object->part.faces)
      depth = std::min(depth, face.plane.offset - dot(to_vec3(face.plane.normal), x));
    return depth;
  }
  const WallField field = wall_field(record, x);
  // A wall ends at its open ends, but what is welded to it may stand out beyond them.
  return record.kind == WallKind::disc ? std::min(field.depth, std::min(field.from_base, field.from_top)) : field.depth;
}

bool is_hidden(const catalog::ConvexPart& part, const catalog::ConvexFace& face, const Wall& wall,
               const WallRecord& record) {
  Vec3 middle;
  Real size = 0;
  const auto corner = [&](std::size_t c) { return to_vec3(part.vertices[static_cast<std::size_t>(face.vertices[c])]); };
  for (std::size_t c = 0; c < face.vertices.size(); ++c) {
    middle += corner(c) / static_cast<Real>(face.vertices.size());
    size = std::max(size, norm(corner(c) - corner(0)));
  }
  for (std::size_t c = 0; c < face.vertices.size(); ++c)
    if (depth_in(wall, record, corner(c)) < -kFlush * size) return false;
  // Between its corners a face chords across a curved wall; just in front of it there must be solid too.
  return depth_in(wall, record, middle + 2 * kFlush * size * to_vec3(face.plane.normal)) > 0;
}

/// Some corner of the volume object `block` lies in or on a wall.
bool has_corner_in(const VolumeObject& block, const Wall& wall, const WallRecord& record) {
  Real size = 0;
  for (const catalog::Point& vertex : block.part.vertices)
    size = std::max(size, norm(to_vec3(vertex) - to_vec3(block.part.vertices[0])));
  return std::any_of(block.part.vertices.begin(), block.part.vertices.end(), [&](const catalog::Point& vertex) {
    return depth_in(wall, record, to_vec3(vertex)) >= -kFlush * size;
  });
}

bool moves_with(const Wall& a, const Wall& b) { return a.motion == b.motion && a.removed_at == b.removed_at; }

}  // namespace

std::vector<std::vector<int>> welded_walls(const Scene& scene) {
  const int count = static_cast<int>(scene.walls.size());
  std::vector<std::vector<int>> welds(scene.walls.size());
  const WallSet at_start(scene, static_cast<int>(scene.shapes.size()));
  const auto stands_in = [&](int block, int wall) {
    const auto* object = std::get_if<VolumeObject>(&scene.walls[block].geometry);
    return object && has_corner_in(*object, scene.walls[wall], at_start.records()[wall]);
  };
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b)
      if (moves_with(scene.walls[a], scene.walls[b]) && (stands_in(a, b) || stands_in(b, a))) {
        welds[a].push_back(b);
        welds[b].push_back(a);
      }
  for (std::vector<int>& list : welds) std::sort(list.begin(), list.end());
  return welds;
}

catalog::ConvexPart welded_part(const Scene& scene, std::size_t wall) {
  const Wall& own = scene.walls[wall];
  catalog::ConvexPart part = std::get<VolumeObject>(own.geometry).part;
  const WallSet at_start(scene, static_cast<int>(scene.shapes.size()));
  for (std::size_t other = 0; other < scene.walls.size(); ++other) {
    const Wall& partner = scene.walls[other];
    if (other == wall || !moves_with(partner, own)) continue;
    for (catalog::ConvexFace& face : part.faces)
      if (is_hidden(part, face, partner, at_start.records()[other])) face.kind = catalog::FaceKind::inner;
  }
  return part;
}

}  // namespace dem_gpu
