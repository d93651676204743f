// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/built_in_solids.h"

namespace shape_pipeline {

// Curved solids; their vertices lie on the surface meant. `detail`: faces along a quarter turn.

/// Cube of half edge 1 with edges and corners rounded by the radius.
BuiltSolid dice_solid(double rounding, int detail);

/// Torus: radius of the tube over that of its centre line.
BuiltSolid ring_solid(double tube, int detail);

/// ((|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) = 1; Barr 1981.
struct Superquadric {
  double e1 = 1, e2 = 1;
  catalog::Point semi_axes{1, 1, 1};
};
BuiltSolid superquadric_solid(const Superquadric& form, int detail);

}  // namespace shape_pipeline
