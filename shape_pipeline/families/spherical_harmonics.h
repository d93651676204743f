// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// The star-shaped mesh with each vertex moved along its ray from the origin to the sum of real spherical harmonics up
/// to `degree` that fits the radii best, each vertex weighted by its solid angle.
catalog::TriangleMesh harmonic_low_pass(const catalog::TriangleMesh& mesh, int degree);

}  // namespace shape_pipeline
