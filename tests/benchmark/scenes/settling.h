// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/snapshot.h"
#include "tests/benchmark/scenes/speed_scenes.h"

namespace benchmark_scenes {

/// A scene at the times of its hardest impacts and of its first window.
struct Settled {
  dem_gpu::Snapshot busy, settled;
};

/// Lets a scene settle: spheres with their own law and step; polyhedra with the volume law, softer and with half the
/// steps in a contact, since all that is taken over is where they lie and how they move. `bodies` as in SceneOptions.
Settled settle(const SpeedScene& speed_scene, int bodies = 0);

/// Steps after which a settled scene, gone on with at its own stiffness, is measured: by then the harder bodies have
/// parted from where the softer ones lay.
inline constexpr int kResettlingSteps = 500;

}  // namespace benchmark_scenes
