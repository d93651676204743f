// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "dem_gpu/core/device_vector.h"
#include "dem_gpu/meshes/box_tree.h"
#include "dem_gpu/narrow_phase/polygon.h"
#include "dem_gpu/scene.h"
#include "dem_gpu/shapes/shape_columns.h"

namespace dem_gpu {

/// A triangle of a mesh and its cell: the convex piece of the layer behind it in which depth is measured from it.
struct MeshFacet {
  int corner[3] = {};                    // vertices, counter-clockwise as seen from outside the solid
  int neighbour[3] = {};                 // facet across the edge from corner i to corner i + 1
  int first_plane = 0, plane_count = 0;  // of the cell; the first one is the facet's own
};

struct MeshRange {
  int first_node = 0, node_count = 0;
};

/// Planes that bound a cell at most.
inline constexpr int kMaxCellPlanes = 32;

/// Triangle meshes, constant during a run, mesh frame (the world's at time 0). Indices run over all meshes.
template <template <class> class Column>
struct MeshTable {
  Column<MeshRange> meshes;    // n_meshes
  Column<MeshFacet> facets;    // n_facets, in the order of the tree's leaves
  Column<HalfSpace> planes;    // of the cells, unit normals
  Column<Vec3> vertices;       // n_vertices [m]
  Column<Vec3> vertex_normal;  // n_vertices, out of the solid, weighted by the facets' angles
  Column<int> fan_first;       // n_vertices + 1
  Column<int> fan;             // facets about each vertex
  Column<BoxNode> nodes;       // boxes about the cells; items are facets
};
template <class T>
using HostColumn = std::vector<T>;
using HostMeshColumns = MeshTable<HostColumn>;
using MeshColumns = MeshTable<DeviceVector>;

struct MeshView {
  const MeshRange* meshes;
  const MeshFacet* facets;
  const HalfSpace* planes;
  const Vec3* vertices;
  const Vec3* vertex_normal;
  const int* fan_first;
  const int* fan;
  const BoxNode* nodes;
};

/// `default_depth`: of the layer behind a mesh that states none [m]. Throws catalog::InputError as contact_surface
/// does.
void append_mesh(HostMeshColumns& columns, const MeshObject& object, Real default_depth);
MeshColumns make_mesh_columns(const HostMeshColumns& host);
MeshView view(const MeshColumns& columns);
MeshView view(const HostMeshColumns& columns);

/// visitor(facet) for each facet whose cell comes within `reach` of x (mesh frame), ascending; false ends the walk.
template <class Visitor>
TALUS_HD void visit_facets_near(const MeshView& mesh, int index, const Vec3& x, Real reach, Visitor&& visitor) {
  const MeshRange range = mesh.meshes[index];
  walk_boxes(
      mesh.nodes + range.first_node, range.node_count, [&](const Box& box) { return box.is_within(x, reach); },
      [&](int f) {
        const MeshFacet& facet = mesh.facets[f];
        for (int p = facet.first_plane; p < facet.first_plane + facet.plane_count; ++p)
          if (-depth_below(mesh.planes[p], x) > reach) return true;
        return visitor(f);
      });
}

}  // namespace dem_gpu
