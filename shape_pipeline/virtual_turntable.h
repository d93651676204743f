// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

#include "shape_pipeline/turntable.h"

namespace shape_pipeline {

struct TurntableRecipe {
  int views = 36;
  int side = 256;               // of the square images [pixels]
  double fill = 0.8;            // share of the side that the grain's largest extent takes, across or along the axis
  double axis_offset = 0;       // of the axis from the middle column [pixels]
  bool is_perspective = false;  // from 6 sizes of the grain away
  double elevation = 0;         // [rad]
  double noise = 3;             // standard deviation [grey values]
  double dark = 30, bright = 210;
  bool is_bright_grain = false;  // on a dark background
  std::uint64_t seed = 1;
};

/// Antialiased images of a mesh that stands with its centre of mass on the axis, and the camera that took them; the
/// axis's column is not told. The mesh's own z is the axis.
TurntableViews virtual_turntable(const catalog::TriangleMesh& mesh, const TurntableRecipe& recipe);

/// Writes the views as view_1.png, view_2.png, ... and turntable.json into a folder, which is made.
void write_turntable(const std::filesystem::path& folder, const TurntableViews& views);

/// Volume [m3] of the visual hull that `views` horizontal orthographic views at equal steps of a whole turn could give
/// at best: of the mesh's own horizontal sections, cut by the strips that bound them in each view, exact in the plane,
/// by midpoints of `slices` along the axis. It needs neither images nor a grid.
double best_hull_volume(const catalog::TriangleMesh& mesh, int views, int slices);

}  // namespace shape_pipeline
