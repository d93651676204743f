// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/mesh_probe.h"

#include "dem_gpu/meshes/mesh_distance.h"

namespace dem_gpu {

struct MeshProbe::Columns {
  HostMeshColumns mesh;
};

MeshProbe::MeshProbe(const MeshObject& object) : columns_(std::make_unique<Columns>()) {
  // The layer behind the surface does not matter here.
  append_mesh(columns_->mesh, object, Real(1e-3));
}
MeshProbe::~MeshProbe() = default;
MeshProbe::MeshProbe(MeshProbe&&) noexcept = default;

Real MeshProbe::distance(const Vec3& x) const {
  const MeshView mesh = view(columns_->mesh);
  FacetPoint nearest;
  nearest.square = Real(1e300);
  int facet = 0;
  walk_boxes(
      mesh.nodes, mesh.meshes[0].node_count,
      [&](const Box& box) { return box.is_within(x, std::sqrt(nearest.square)); },
      [&](int f) {
        const FacetPoint closest = closest_on_facet(mesh, f, x);
        if (closest.square < nearest.square) nearest = closest, facet = f;
        return true;
      });
  const Real distance = std::sqrt(nearest.square);
  return dot(x - nearest.point, pseudonormal(mesh, facet, nearest)) < 0 ? -distance : distance;
}

}  // namespace dem_gpu
