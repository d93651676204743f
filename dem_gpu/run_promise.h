// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// Points on the curve of speed against error.
enum class Preset { draft, standard, reference };

/// What a run of a preset promises; the run checks it at its end and says so.
struct Promise {
  const char* name;
  Real steps_per_contact;  // in the stiffest contact
  Real energy_imbalance;   // largest, share of the energy put in [-]
  Real largest_overlap;    // of any contact, share of the smaller body's equivalent diameter [-]
  Real restitution_error;  // largest, of an impact of polyhedra, 0.05 to 1 asked for [-]
};

/// The energy error of an elastic contact falls with the third power of the step and more: its restitution is off by
/// 1e-3, 1.5e-4 and 2e-5 at 10, 20 and 40 steps of a linear contact (velocity Verlet, direct calculation). That of a
/// dashpot falls with the second: faces that land flat are off by up to 0.022, 0.006 and 0.002. The overlap promised is
/// a matter of the scene's stiffness, not of the step: beyond it a grain is no longer the shape that it was given.
inline constexpr Promise promise_of(Preset preset) {
  constexpr Promise kPromises[] = {{"draft", 10, Real(1e-2), Real(0.3), Real(0.03)},
                                   {"standard", 20, Real(1e-3), Real(0.2), Real(0.01)},
                                   {"reference", 40, Real(2e-4), Real(0.1), Real(0.01)}};
  return kPromises[static_cast<int>(preset)];
}

}  // namespace dem_gpu
