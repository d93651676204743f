// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/polyhedron_geometry.h"

namespace dem_gpu {

std::unique_ptr<Pass> make_polyhedron_object_contacts_pass(const Scene& scene) {
  return make_contact_pass("polyhedron_object_contacts", ContactKind::polyhedron_object, scene, scene.polyhedral_law,
                           polyhedron_friction(scene), [](const auto& law) {
                             return PolyhedronGeometry<std::decay_t<decltype(law)>, WallPartner>{law};
                           });
}

}  // namespace dem_gpu
