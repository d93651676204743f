// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "catalog/shape_record.h"

namespace shape_pipeline {

// Shapes made from a shape. Each keeps the volume, and throws InputError for what is asked in vain: the text names what
// is allowed and the nearest that was reached. The mesh is closed and outward, with its centroid at the origin.

/// A changed mesh and the checks that say how it was made and how well.
struct FamilyMember {
  catalog::TriangleMesh mesh;
  std::vector<catalog::Check> checks;
};

/// Stretched along the axes of its box of least volume until the box has these ratios, S/I and I/L in (0, 1], to
/// 1e-6.
FamilyMember stretched(const catalog::TriangleMesh& mesh, double s_over_i, double i_over_l);

/// Rounded or sharpened until "angularity_corner_radius" differs from the target by at most the tolerance: x = y + t
/// (x0
/// - y), where x0 is the mesh remeshed to about 6000 even faces and y that smoothed by 300 steps of the umbrella
/// operator; t < 1 rounds, 1 < t <= 3 sharpens, found by halving. A surface that cuts itself is never taken.
FamilyMember with_angularity(const catalog::TriangleMesh& mesh, double target, double tolerance);

/// With flatter or deeper hollows until V / V_hull differs from the target by at most the tolerance: x = x0 - t w,
/// where x0 is the mesh remeshed to about 6000 even faces and w its vertices' ways to the hull (families/hull_blend.h);
/// t from -1, nearly the hull, to 4, found by halving. A surface that cuts itself is never taken. A convex shape has no
/// hollows to deepen.
FamilyMember with_convexity(const catalog::TriangleMesh& mesh, double target, double tolerance);

/// Without detail finer than `degree` (1 to 30). A shape that is star-shaped about its centroid is the sum of its
/// spherical harmonics up to that degree by least squares over the vertices, weighted by solid angle (Garboczi 2002);
/// any other is smoothed by the lambda-mu filter (Taubin 1995) with a pass band up to the wave number degree / R, R the
/// radius of the sphere of equal volume. The check "low_pass_METHOD" carries the root mean square change of the
/// vertices over R.
FamilyMember low_passed(const catalog::TriangleMesh& mesh, int degree);

/// Whether every face is seen from the origin from inside.
bool is_star_shaped(const catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
