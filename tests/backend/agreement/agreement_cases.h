// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem_gpu/scene.h"
#include "dem_gpu/snapshot.h"

namespace agreement {

// What two back ends compute from the same start: one step to rounding, a bulk within what other seeds make of it.

/// A small scene of the speed benches.
struct Case {
  std::string name;
  dem_gpu::Scene scene;
  double settling_time = 0.2;  // bodies have landed on each other; in the mill, lifters stand as at the start [s]
};

/// Spheres and polyhedra with friction, convex and not, under both laws, in boxes and drums.
std::vector<Case> cases();

/// Bodies heaped up, not yet at rest.
dem_gpu::Snapshot settled(const Case& agreement_case);

/// State `steps` after `start`; friction begins anew there.
dem_gpu::Snapshot after_steps(const Case& agreement_case, const dem_gpu::Snapshot& start, int steps);

/// Means over the later half of a bulk run.
struct Bulk {
  double kinetic_energy = 0;  // [J]
  double mean_height = 0;     // of the centre of mass [m]
  double coordination = 0;    // bodies that touch one [-]
};

/// A bulk run from `start`, each body pushed by up to kPush along each axis as the seed has it.
Bulk bulk(const Case& agreement_case, const dem_gpu::Snapshot& start, std::uint64_t seed);
inline constexpr double kPush = 0.1;  // [m/s]

}  // namespace agreement
