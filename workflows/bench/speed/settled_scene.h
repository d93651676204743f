// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/benchmark/scenes/speed_scenes.h"

namespace workflows {

/// When in a scene's life it is measured.
enum class Moment { busy, settled };

/// The scene as it is at that moment. Each scene settles once in the life of the process
/// (tests/benchmark/scenes/settling.h). Run it on for benchmark_scenes::kResettlingSteps before it is measured.
dem_gpu::Scene scene_at(const benchmark_scenes::SpeedScene& speed_scene, Moment moment,
                        const benchmark_scenes::SceneOptions& options);

}  // namespace workflows
