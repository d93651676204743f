// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/broad_phase/candidate_pairs.h"

#include "dem_gpu/broad_phase/cell_grid.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/periodic/ghosts.h"
#include "dem_gpu/walls/wall_surface.h"

namespace dem_gpu {
namespace {

TALUS_HD ContactKey pair_key(const ShapeRange* shapes, const int* shape, int i, int j) {
  const bool i_is_sphere = shapes[shape[i]].part_count == 0, j_is_sphere = shapes[shape[j]].part_count == 0;
  if (i_is_sphere == j_is_sphere)
    return contact_key(i_is_sphere ? ContactKind::sphere_sphere : ContactKind::polyhedron_polyhedron, i < j ? i : j,
                       i < j ? j : i);
  return contact_key(ContactKind::sphere_polyhedron, i_is_sphere ? i : j, i_is_sphere ? j : i);
}

TALUS_HD ContactKey wall_key(const ShapeRange* shapes, int shape, const WallRecord& wall, int body, int index) {
  const bool is_sphere = shapes[shape].part_count == 0;
  ContactKind kind = is_sphere ? ContactKind::sphere_wall : ContactKind::polyhedron_wall;
  if (wall.kind == WallKind::volume_object)
    kind = is_sphere ? ContactKind::sphere_object : ContactKind::polyhedron_object;
  if (wall.kind == WallKind::mesh) kind = is_sphere ? ContactKind::sphere_mesh : ContactKind::polyhedron_mesh;
  return contact_key(kind, body, index);
}

/// May a ball of radius `reach` about x touch the wall?
TALUS_HD bool is_near_wall(const ShapeView& shapes, const MeshView& meshes, const WallRecord& wall, const Vec3& x,
                           Real reach) {
  if (!wall.is_present) return false;
  if (wall.kind == WallKind::mesh) {
    bool is_near = false;
    visit_facets_near(meshes, wall.mesh, rotate_back(wall.orientation, x - wall.point), reach, [&](int /*facet*/) {
      is_near = true;
      return false;
    });
    return is_near;
  }
  if (wall.kind == WallKind::volume_object) {
    const PartView part = part_view(shapes, shapes.shapes[wall.shape].first_part);
    const Vec3 local = rotate_back(wall.orientation, x - wall.point);
    for (int f = 0; f < part.range.face_count; ++f)
      if (depth_below<Real>(part.planes[f], local) < -reach) return false;
    return true;
  }
  const WallField field = wall_field(wall, x);
  return field.depth > -reach && field.from_base > -reach && field.from_top > -reach;
}

/// Candidate pairs that a range of grid entries has room for while its pairs are counted: most ranges are searched
/// once. On the GPU, where each entry is a range of its own, a second search costs less than the memory.
constexpr int kRoom = kRangeLength > 1 ? 8 * kRangeLength : 0;

/// Counts (keys == nullptr) or writes the candidate pairs of a range of grid entries: of bodies with each other or with
/// ghosts, and with walls. A sphere meets every ghost of a polyhedron.
struct ListPairs {
  BodyView bodies;  // with ghosts
  GhostView ghosts;
  ShapeView shapes;
  MeshView meshes;
  CellGrid::View grid;
  const WallRecord* walls;
  int wall_count;
  int* first;         // of each range
  ContactKey* found;  // by the count, as far as there is room; kRoom each range
  ContactKey* keys;

  TALUS_HD void operator()(int begin, int end) const {
    const int range = begin / kRangeLength;
    ContactKey* const room = found + static_cast<std::ptrdiff_t>(range) * kRoom;
    if (!keys) {
      first[range] = search(begin, end, room, kRoom);
      return;
    }
    const int count = first[range + 1] - first[range];
    if (count > kRoom)
      search(begin, end, keys + first[range], count);
    else
      for (int k = 0; k < count; ++k) keys[first[range] + k] = room[k];
  }

  /// Number of pairs; the first `room` are written.
  TALUS_HD int search(int begin, int end, ContactKey* out, int room) const {
    int count = 0;
    const auto add = [&](ContactKey key) {
      if (count < room) out[count] = key;
      ++count;
    };
    NeighbourSearch neighbours(grid);
    for (int entry = begin; entry < end; ++entry) {
      const int i = grid.body[entry];
      neighbours.visit(entry, [&](int other) {
        const int j = grid.body[other];
        if (is_pair(i, j)) add(pair_key(shapes.shapes, bodies.shape, i, j));
      });
      if (ghosts.is_ghost(i) || bodies.is_fixed(i)) continue;
      const Real reach = bodies.bounding_radius[i] + grid.skin;
      for (int w = 0; w < wall_count; ++w)
        if (is_near_wall(shapes, meshes, walls[w], bodies.position[i], reach))
          add(wall_key(shapes.shapes, bodies.shape[i], walls[w], i, w));
    }
    return count;
  }

  /// Of the ghosts a pair could be met at, it is met at the one: of the body of higher index, of the polyhedron.
  TALUS_HD bool is_pair(int i, int j) const {
    if (bodies.is_fixed(i) && bodies.is_fixed(j)) return false;
    if (ghosts.is_ghost(i)) return !ghosts.is_ghost(j) && meets_ghost(j, i);
    return !ghosts.is_ghost(j) || meets_ghost(i, j);
  }
  TALUS_HD bool meets_ghost(int body, int ghost) const {
    const bool is_sphere = shapes.shapes[bodies.shape[body]].part_count == 0,
               ghost_is_sphere = shapes.shapes[bodies.shape[ghost]].part_count == 0;
    return is_sphere == ghost_is_sphere ? body < ghosts.owner(ghost) : is_sphere;
  }
};

}  // namespace

DeviceVector<ContactKey> candidate_keys(const Model& model, State& state) {
  const BodyView bodies = bodies_with_ghosts(model, state);
  CellGrid grid;
  grid.build(bodies, state.skin);
  const int entries = grid.view().count;
  const auto ranges = static_cast<std::size_t>(range_count(entries));
  DeviceVector<int> first(ranges + 1, 0);
  DeviceVector<ContactKey> found(ranges * kRoom);
  ListPairs list{bodies,
                 ghost_view(model, state),
                 view(model.shapes.columns),
                 view(model.meshes),
                 grid.view(),
                 state.walls.device(),
                 state.walls.count(),
                 pointer(first),
                 pointer(found),
                 nullptr};
  parallel_for_ranges(0, entries, list);
  DeviceVector<ContactKey> keys(static_cast<std::size_t>(exclusive_scan(first)));
  list.keys = pointer(keys);
  if (!keys.empty()) parallel_for_ranges(0, entries, list);
  sort(keys);
  return keys;
}

}  // namespace dem_gpu
