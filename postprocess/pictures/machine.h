// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "postprocess/pictures.h"
#include "postprocess/surfaces/surface.h"

namespace postprocess {

/// The largest cylinder or cone of a scene, and what kind of machine that makes it.
struct Machine {
  SceneKind kind = SceneKind::open;
  dem_gpu::Vec3 point;          // on the axis [m]
  dem_gpu::Vec3 axis{0, 0, 1};  // unit
  double radius = 0;            // [m]
};

Machine machine_of(const std::vector<dem_gpu::WallGeometry>& walls, const dem_gpu::Vec3& up);

/// The wall as it is drawn: a plane across a drum's axis becomes a disc as large as the drum.
dem_gpu::WallGeometry as_drawn(const dem_gpu::WallGeometry& wall, const Machine& machine);

}  // namespace postprocess
