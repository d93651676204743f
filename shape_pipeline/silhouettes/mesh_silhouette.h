// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/micrographs/raster.h"
#include "shape_pipeline/silhouettes/turntable_camera.h"

namespace shape_pipeline {

/// Share of each pixel that a closed mesh covers in a view: exact along the rows, by 8 lines down a pixel.
Raster<float> mesh_coverage(const catalog::TriangleMesh& mesh, const TurntableProjection& projection, int width,
                            int height);

}  // namespace shape_pipeline
