// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "dem_gpu/snapshot.h"

namespace postprocess {

/// Which machine a scene shows, told from its walls.
enum class SceneKind { drum, hopper, open };

/// A view of a run that all its pictures share.
struct PictureView {
  SceneKind kind = SceneKind::open;
  dem_gpu::Vec3 eye;       // [m]
  dem_gpu::Vec3 focus;     // [m]
  dem_gpu::Vec3 up;        // unit
  double view_angle = 25;  // full angle of the picture's height [degrees]
  double fastest = 1;      // speed at the top of the colour scale [m/s]
};

struct PictureSize {
  int width = 1200;  // [px]
  int height = 900;  // [px]
};

/// Sets the camera and the colour scale so that all `snapshots` fit. A drum (largest cylinder lies across `up`) is
/// looked at along its axis, anything else from the side. `up` is opposite to gravity, unit.
PictureView picture_view(const dem_gpu::RunGeometry& geometry, const std::vector<dem_gpu::Snapshot>& snapshots,
                         const dem_gpu::Vec3& up, const PictureSize& size = {});

/// PNG file, as bytes, of one snapshot: bodies coloured by speed; the far half of shells and cones solid, the near half
/// like glass. Needs a display (xvfb-run gives one): VTK ends the process if it cannot open it.
std::string picture_png(const dem_gpu::RunGeometry& geometry, const dem_gpu::Snapshot& snapshot,
                        const PictureView& view, const PictureSize& size = {});

}  // namespace postprocess
