// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/snapshot.h"
#include "tests/benchmark/scenes/speed_scenes.h"

namespace benchmark_scenes {

/// Settled beds side by side, along x and y: a large bed at the cost of settling a small one. The box scenes alone
/// (s1-box, s2, s3) widen by tiles and keep their depth.
/// `settled`: of the scene with its own number of bodies. Goes with tiles * tiles as many, which `resumed` puts them
/// in. Throws catalog::UsageError for another scene, and for tiles < 1.
dem_gpu::Snapshot tiled(const SpeedScene& speed_scene, const dem_gpu::Snapshot& settled, int tiles);

}  // namespace benchmark_scenes
