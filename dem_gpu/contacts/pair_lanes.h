// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/contact_scene.h"
#include "dem_gpu/core/row_columns.h"

namespace dem_gpu {

/// Contacts side by side, one a lane, and what stands on either side of them.
struct PairRows {
  RowLanes contact, a, b;
};

/// Properties of the pairs of materials.
using PairLanes = BasicPairProperties<RealLanes>;

/// `material_b(i)`: of the other side in lane i.
template <class MaterialB>
TALUS_HD PairLanes pair_lanes(const ContactScene& scene, const PairRows& rows, const MaterialB& material_b) {
  const auto property = [&](Real PairProperties::*of) {
    RealLanes lanes = RealLanes{} + scene.pairs[0].*of;
    if (scene.material_count > 1)
      lanes = lanes_of([&](int i) { return scene.pair(scene.bodies.material[rows.a[i]], material_b(i)).*of; });
    return lanes;
  };
  return {property(&PairProperties::damping_ratio),
          property(&PairProperties::friction_coefficient),
          property(&PairProperties::effective_modulus),
          property(&PairProperties::sphere_damping),
          property(&PairProperties::tangential_stiffness_ratio),
          property(&PairProperties::rolling_friction),
          property(&PairProperties::adhesion),
          property(&PairProperties::sphere_tangential_damping)};
}

}  // namespace dem_gpu
