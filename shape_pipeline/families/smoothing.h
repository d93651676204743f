// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Each step moves every vertex by `share` of the way to the mean of its neighbours (the umbrella operator).
catalog::TriangleMesh umbrella_steps(catalog::TriangleMesh mesh, double share, int steps);

/// Taubin's lambda-mu filter: waves longer than 2 pi / `wave_number` [1/m] stay, shorter ones go; no shrinking.
catalog::TriangleMesh taubin_low_pass(const catalog::TriangleMesh& mesh, double wave_number);

}  // namespace shape_pipeline
