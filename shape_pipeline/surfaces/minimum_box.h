// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/mass_properties.h"
#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

struct OrientedBox {
  catalog::Matrix3 axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // rows, unit
  catalog::Point extent{};                                   // along each row [m]

  double volume() const { return extent[0] * extent[1] * extent[2]; }
};

/// Box of least volume about a convex hull: candidates are boxes flush with the largest hull faces and the result of
/// CGAL's search, each turned about its own axes until no turn makes it smaller. Exact for boxes; elsewhere it finds
/// the smallest to within the search (never proven).
OrientedBox minimum_volume_box(const catalog::TriangleMesh& hull);

}  // namespace shape_pipeline
