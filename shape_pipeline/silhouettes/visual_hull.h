// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/silhouettes/silhouette_image.h"
#include "shape_pipeline/silhouettes/turntable_camera.h"

namespace shape_pipeline {

/// A silhouette and how it was seen.
struct HullView {
  SilhouetteImage silhouette;
  TurntableProjection projection;
};

struct VisualHull {
  catalog::TriangleMesh mesh;  // every surface of it, outward, in the turntable's frame [m]; none if the views agree on
                               // no point
  double cell = 0;             // side of the grid's cells [m]
  double counted_volume = 0;   // of the cells whose middle is inside [m3]
};

/// The visual hull (Laurentini 1994): all points that every silhouette covers. Their depth is the least of the signed
/// distances to the silhouettes' outlines, exact beside the hull's faces, on a grid of `cells` along its longest side;
/// only blocks that the surface may cross are worked out. The surface is that of depth 0 (level_surface). None if the
/// views do not bound the hull.
std::optional<VisualHull> visual_hull(const std::vector<HullView>& views, int cells);

}  // namespace shape_pipeline
