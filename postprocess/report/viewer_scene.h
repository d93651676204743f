// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postprocess/pictures.h"

namespace postprocess {

/// JSON for report/viewer.js; arrays are base64 of little-endian numbers:
///   shapes[], walls[]: corners (int16 x 3, times radius / 32767), triangles (uint32 x 3), radius [m], round, solid
///   shapeOf (uint16), scaleOf (float32): one a body
///   frames[]: time [s]; place (uint16 x 3 a body, over low .. low + span), turn (int16 x 4: x y z w),
///             speed (uint8 a body: of `fastest`, 254 at most, 255 has left),
///             walls (float32 x 8 a wall: translation, rotation x y z w, 1 if present)
///   low, span [m]; eye, focus, up, vertical, angle: the first view
std::string viewer_scene_json(const dem_gpu::RunGeometry& geometry, const std::vector<dem_gpu::Snapshot>& frames,
                              const PictureView& view, const dem_gpu::Vec3& vertical);

/// How many frames of that many bodies keep the page within a size that a browser opens at once.
std::size_t viewer_frame_limit(std::size_t bodies);

}  // namespace postprocess
