// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Descriptors of a closed mesh in metres. V: volume, A: area, S <= I <= L: sides of the box of least volume (obb).
///
///   volume, surface_area, volume_hull              [m3, m2, m3]
///   equivalent_diameter_volume                     (6 V / pi)^(1/3) [m]
///   sphericity_wadell                              pi^(1/3) (6 V)^(2/3) / A; Wadell 1932
///   convexity_volume_ratio                         V / V_hull
///   axis_short_obb, axis_intermediate_obb, axis_long_obb   S, I, L [m]
///   zingg_s_over_i, zingg_i_over_l                 S / I, I / L; Zingg 1935
///   sphericity_krumbein_intercept                  (S I / L^2)^(1/3); Krumbein 1941
///   flatness_kong_fonseca, elongation_kong_fonseca (I - S) / I, (L - I) / L; Kong & Fonseca 2018
///   compactness_, flakiness_, rodness_bagi_orosz   f3 / f1, (f1 - f2) / f1, (f2 - f3) / f1, which sum to 1, with
///                                                  f1 >= f2 >= f3 of sum A_k n n^T / A; Bagi & Orosz 2020
///   feret_max                                      largest distance of two vertices [m]
///   sieve_size_second_axis                         I: the square mesh that lets the particle pass end on [m]
///   face_count, mean_edge_length                   resolution of the mesh, which A depends on [-, m]
std::map<std::string, double> shape_descriptors(const catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
