// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/scene.h"

namespace workflows {

/// Puts a mesh of `cells` x `cells` squares, two triangles each, in the place of the wall "floor", a little wider than
/// the box, with 20 mm of solid behind it.
void make_floor_a_mesh(dem_gpu::Scene& scene, int cells);

}  // namespace workflows
