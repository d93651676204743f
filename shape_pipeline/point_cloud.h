// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Scanned points in metres; normals are unit and outward once oriented, or absent.
struct PointCloud {
  std::vector<catalog::Point> points;   // n_points x 3 [m]
  std::vector<catalog::Point> normals;  // n_points x 3, or empty

  bool has_normals() const { return !points.empty() && normals.size() == points.size(); }
};

}  // namespace shape_pipeline
