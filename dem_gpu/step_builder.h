// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "dem_gpu/core/pass.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {

/// The passes of a step, in order: only what the scene has.
std::vector<std::unique_ptr<Pass>> build_step(const Scene& scene);

}  // namespace dem_gpu
