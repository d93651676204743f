// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/laws/depth_potential.h"

namespace dem_gpu {

/// Depth potential with psi = depth (1 + depth / l) in place of the depth: any function of the fields keeps force and
/// torque an exact gradient. l is `hardening` times the smaller body's equivalent diameter. Flat on flat:
/// F = 2 k A d (1 + d / l), twice as hard at d = l. It narrows how much softer corners are than faces: a corner sinks
/// in 9 times as far as a face where l is small against the face's overlap, 13 times where it is large.
struct HardeningDepthPotential : DepthPotential {
  Real hardening = Real(0.03);  // l / equivalent diameter of the smaller body [-]
  /// Overlap of flat faces that the time step reckons with, as a share of the diameter [-]; deeper flat contacts take
  /// fewer steps than asked.
  Real flat_overlap = Real(0.03);
};

}  // namespace dem_gpu
