// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Height of a surface over smooth patches of it, with the names and formulas of ISO 25178-2:2012 (4.1.1 to 4.1.7,
/// 4.3.1). Each is the median over the patches, since a patch on a ridge has its height and no roughness.
struct SurfaceRoughness {
  double patch_radius = 0;  // [m]
  double sa = 0;            // mean of |z| by area [m]
  double sq = 0;            // root mean square of z [m]
  double ssk = 0;           // mean of z^3 / Sq^3; 0 where Sq is 0
  double sku = 0;           // mean of z^4 / Sq^4; 3 where Sq is 0
  double sdq = 0;           // root mean square of the slope of z [-]
};

/// Of a closed, outward mesh: at 200 places spread over the area, the patch within `patch_radius` that is turned the
/// same way, and its heights z over the second-order polynomial that fits it best (the F-operator of ISO 25178-3).
/// Waves longer than the patch are form and not seen, waves shorter than the faces are not there. A smooth sphere of
/// radius r shows about 0.03 patch_radius^4 / r^3. Large faces are flat. None for bodies so thin that their surface is
/// beyond 6000 patch_radius^2.
std::optional<SurfaceRoughness> surface_roughness(const catalog::TriangleMesh& mesh, double patch_radius);

}  // namespace shape_pipeline
