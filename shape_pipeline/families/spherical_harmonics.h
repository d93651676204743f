// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Real spherical harmonics at a unit vector, orthonormal over the sphere: (degree + 1)^2 values, order m of degree n
/// at n (n + 1) + m.
std::vector<double> real_harmonics(const catalog::Point& direction, int degree);

/// The star-shaped mesh with each vertex moved along its ray from the origin to the sum of real spherical harmonics up
/// to `degree` that fits the radii best, each vertex weighted by its solid angle.
catalog::TriangleMesh harmonic_low_pass(const catalog::TriangleMesh& mesh, int degree);

}  // namespace shape_pipeline
