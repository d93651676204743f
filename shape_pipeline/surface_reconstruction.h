// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "catalog/shape_record.h"
#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

enum class ReconstructionMethod { automatic, poisson, alpha_wrap };

struct ReconstructionOptions {
  ReconstructionMethod method = ReconstructionMethod::automatic;
  int genus = 0;  // handles of the particle: 0 for a stone, 1 for a ring
};

/// A closed mesh, or the reason why there is none.
struct Reconstruction {
  catalog::TriangleMesh mesh;          // empty if refused
  std::vector<catalog::Check> checks;  // cleaning steps, then the checks of the solid
  std::string refusal;                 // one line; empty if the mesh may be used
};

/// Surface of a scanned particle: duplicates merged, outliers removed, normals estimated (or the given ones used if
/// they agree with the points), Poisson reconstruction; where its solid fails a check, alpha wraps from fine to coarse,
/// drawn onto the cloud. The volume is checked against the winding-number volume of the cloud and against its hull.
Reconstruction reconstruct_surface(const PointCloud& cloud, const ReconstructionOptions& options);

/// Average distance [m] of a point to its six nearest neighbours.
double average_spacing(const std::vector<catalog::Point>& points);

}  // namespace shape_pipeline
