// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Size and form of one grain, by descriptors of shape_descriptors.h.
struct GrainForm {
  double diameter = 0;    // of the sphere of equal volume [m]
  double s_over_i = 1;    // axis_short_inertia / axis_intermediate_inertia
  double i_over_l = 1;    // axis_intermediate_inertia / axis_long_inertia
  double convexity = 1;   // convexity_volume_ratio
  double sphericity = 1;  // sphericity_wadell
};

/// A grain made to a form, and how near it came. Diameter and axes are exact.
struct TargetGrain {
  catalog::TriangleMesh mesh;   // 1,728 faces, star-shaped about a point inside, outward; centroid at the origin [m]
  double convexity_error = 0;   // made less asked for
  double sphericity_error = 0;  // made less asked for
  double amplitude = 0;         // a: standard deviation of the logarithm of the radius
  double level = 0;             // q: above 0 the surface has bumps, below 0 dents
  double exponent = 0;          // b of the spectrum
  int fields = 0;               // random fields tried

  /// Both errors within 0.001.
  bool is_reached() const;
};

/// A random grain of the form. The radius about a point is exp(a g), g = tanh(f - q) standardised, f a Gaussian field
/// of spherical harmonics of degrees 3 to 9 whose power a degree falls as degree^-b (f: Grigoriu, Garboczi & Kafali
/// 2006). One linear map then gives the solid the axes of inertia asked for; convexity does not change under it. a is
/// found so that the convexity comes out, q in [-1.5, 1.5] so that the sphericity does, both by false position; b is 2,
/// and where q does not reach, other fields with b = 0, 4 and 8 are tried and the nearest is kept: the convexity is met
/// before the sphericity. The same form and seed give the same grain. Throws InputError for a figure that no solid has.
TargetGrain target_grain(const GrainForm& form, std::uint64_t seed);

}  // namespace shape_pipeline
