// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/contact_patch.h"
#include "dem_gpu/contacts/laws/depth_potential.h"
#include "dem_gpu/contacts/laws/hardening_depth_potential.h"
#include "dem_gpu/walls/wall_integrals.h"

namespace dem_gpu {

/// A law's integrals before any overlap. `diameter`: equivalent, of the body [m].
template <class Sums, class Law>
TALUS_HD WallIntegralsOf<LinearProfile, Sums> empty_wall_integrals(const Law&, Real /*diameter*/) {
  return {};
}
template <class Sums>
TALUS_HD WallIntegralsOf<HardeningProfile, Sums> empty_wall_integrals(const HardeningDepthPotential& law,
                                                                      Real diameter) {
  WallIntegralsOf<HardeningProfile, Sums> integrals;
  integrals.profile.rate = rounded(1 / (law.hardening * diameter));
  return integrals;
}

/// The contact of a body about `centre` that the integrals give; false without overlap. A flat face meets a wall as
/// stiffly as another flat face. With the volume law too: the integral of the depth over the surface inside a flat wall
/// is the overlap volume.
template <class Law, class Integrals, class Patch>
TALUS_HD bool wall_contact(const Law& law, const Integrals& integrals, const Vec3& centre, ElasticContact& elastic,
                           Patch& patch) {
  if (!integrals.to_contact(law.stiffness_per_area(), centre, elastic)) return false;
  if constexpr (Integrals::kHasPatch) patch = integrals.to_patch(law.stiffness_per_area());
  return true;
}

}  // namespace dem_gpu
