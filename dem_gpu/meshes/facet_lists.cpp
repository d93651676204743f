// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/meshes/facet_lists.h"

#include "dem_gpu/core/parallel.h"

namespace dem_gpu {
namespace {

/// Counts (facets == nullptr) or writes the facets of contact c.
struct ListFacets {
  const ContactKey* key;
  BodyView bodies;
  const WallRecord* walls;
  MeshView meshes;
  Real skin;  // [m]
  int* begin;
  int* facets;

  TALUS_HD void operator()(int c) const {
    int count = 0;
    if (is_mesh_kind(key_kind(key[c]))) {
      const int body = key_body_a(key[c]);
      const WallRecord& wall = walls[key_body_b(key[c])];
      int* out = facets ? facets + begin[c] : nullptr;
      visit_facets_near(meshes, wall.mesh, rotate_back(wall.orientation, bodies.position[body] - wall.point),
                        bodies.bounding_radius[body] + skin, [&](int facet) {
                          if (out) out[count] = facet;
                          ++count;
                          return true;
                        });
    }
    if (!facets) begin[c] = count;
  }
};

}  // namespace

void list_facets(const Model& model, State& state, ContactColumns& contacts) {
  const int count = static_cast<int>(contacts.key.size());
  ListFacets list{pointer(contacts.key),
                  view(model.bodies, state.bodies),
                  state.walls.device(),
                  view(model.meshes),
                  state.skin,
                  pointer(contacts.facet_begin),
                  nullptr};
  parallel_for(0, count, list);
  contacts.facet.resize(static_cast<std::size_t>(exclusive_scan(contacts.facet_begin)));
  list.facets = pointer(contacts.facet);
  if (!contacts.facet.empty()) parallel_for(0, count, list);
}

}  // namespace dem_gpu
