// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

struct HoleFilling {
  std::size_t filled = 0;
  std::size_t left_open = 0;
  double filled_area = 0;  // [m2]
};

/// Closes each border loop of an oriented manifold by triangles (least area, then largest angle), refined to the
/// density around it and faired to continue the surface's slope (Liepa 2003).
HoleFilling fill_holes(catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
