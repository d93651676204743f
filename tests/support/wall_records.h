// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "dem_gpu/walls/wall_columns.h"
#include "tests/support/dem_scenes.h"

namespace test_support {

/// One wall as the kernels see it at time 0.
inline dem_gpu::WallRecord record_of(decltype(dem_gpu::Wall::geometry) geometry) {
  dem_gpu::Scene scene = empty_scene(1, 0);
  dem_gpu::Wall wall;
  wall.name = "wall";
  wall.geometry = std::move(geometry);
  scene.walls = {wall};
  return dem_gpu::WallSet(scene, 0).records()[0];
}

}  // namespace test_support
