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

/// D_n = sqrt(sum over m of a_nm^2), n = 0 to `degree`, of the radius of a mesh that is star-shaped about the origin,
/// r = sum of a_nm Y_nm with Y_nm real and orthonormal over the sphere. They do not change when the mesh is turned
/// (Garboczi 2002; as descriptors Zhou et al. 2015). Integrated over the faces to about 1e-6 of D_0 up to degree 15.
std::vector<double> harmonic_amplitudes(const catalog::TriangleMesh& mesh, int degree);

}  // namespace shape_pipeline
