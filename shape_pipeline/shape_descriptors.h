// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Descriptors of a closed mesh in metres; sources and remarks in docs/descriptors.md. V: volume, A: area, S <= I <= L:
/// sides of the box of least volume (obb).
///
///   volume, surface_area, volume_hull              [m3, m2, m3]
///   equivalent_diameter_volume                     (6 V / pi)^(1/3) [m]
///   sphericity_wadell                              pi^(1/3) (6 V)^(2/3) / A; Wadell 1932
///   convexity_volume_ratio                         V / V_hull
///   axis_short_obb, axis_intermediate_obb, axis_long_obb   S, I, L [m]
///   axis_short_, axis_intermediate_, axis_long_inertia     axes of the ellipsoid of equal volume and inertia tensor
///   over
///                                                  volume, sqrt(20 V_kk / V) with V_kk the integral of x_k^2 [m]
///   zingg_s_over_i, zingg_i_over_l                 S / I, I / L; Zingg 1935
///   sphericity_krumbein_intercept                  (S I / L^2)^(1/3); Krumbein 1941
///   sphericity_sneed_folk                          (S^2 / (L I))^(1/3); Sneed & Folk 1958
///   shape_factor_corey                             S / sqrt(L I); Corey 1949
///   flatness_kong_fonseca, elongation_kong_fonseca (I - S) / I, (L - I) / L; Kong & Fonseca 2018
///   flatness_potticary, elongation_potticary       2 (I - S) / (S + I + L), (L - I) / (S + I + L); Potticary et al.
///   2015 flatness_angelidakis, elongation_angelidakis   I^2 / (S L + I^2) - S / (S + L), S L / (S L + I^2) - S / (S +
///   L);
///                                                  Angelidakis et al. 2022
///   compactness_, flakiness_, rodness_bagi_orosz   f3 / f1, (f1 - f2) / f1, (f2 - f3) / f1, which sum to 1, with
///                                                  f1 >= f2 >= f3 of sum A_k n n^T / A; Bagi & Orosz 2020
///   feret_max, feret_min                           largest distance of two vertices, least distance of two parallel
///                                                  planes about the solid [m]
///   radius_inscribed, radius_enclosing             of the largest sphere inside, the smallest about the solid [m]
///   sphericity_inscribed_enclosing                 their ratio; Bullard & Garboczi 2013
///   roundness_corner_radius, angularity_corner_radius, corner_area_share, corner_scale [-, -, -, m]
///                                                  see surfaces/corner_measure.h; left out for thin solids
///   corner_scale_over_edge                         corner_scale / mean_edge_length: below 1 the mesh is too coarse
///   roughness_sa_, _sq_, _ssk_, _sku_, _sdq_iso25178, roughness_patch_radius
///                                                  see surfaces/surface_roughness.h [m, m, -, -, -, m]
///   harmonic_d02_ to _d15_over_d00_garboczi        see families/spherical_harmonics.h; left out where the solid is not
///                                                  star-shaped about its centroid
///   sieve_size_second_axis                         I: the square mesh that lets the particle pass end on [m]
///   face_count, mean_edge_length                   resolution of the mesh, which A depends on [-, m]
std::map<std::string, double> shape_descriptors(const catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
