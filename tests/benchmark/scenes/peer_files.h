// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "dem_gpu/scene.h"

namespace benchmark_scenes {

/// A data file of the scene's spheres for LAMMPS and LIGGGHTS: where they begin, at rest. The axis of a
/// drum becomes z, and down -x.
/// Throws catalog::InputError if there are other bodies.
std::string lammps_particles(const dem_gpu::Scene& scene);

/// A line a shape, "# sphere RADIUS" or "# VERTICES as x y z ...", then a line a body, "shape x y z w x y z" (centre
/// and orientation). Throws catalog::InputError for a shape of several parts.
std::string particle_table(const dem_gpu::Scene& scene);

}  // namespace benchmark_scenes
