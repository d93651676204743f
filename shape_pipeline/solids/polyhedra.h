// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "shape_pipeline/built_in_solids.h"

namespace shape_pipeline {

// Convex polyhedra with flat faces, each with its exact volume.
BuiltSolid tetrahedron_solid();
BuiltSolid cube_solid();
BuiltSolid octahedron_solid();
BuiltSolid dodecahedron_solid();
BuiltSolid icosahedron_solid();
BuiltSolid truncated_tetrahedron_solid();
BuiltSolid bilunabirotunda_solid();               // Johnson 1966, J91
BuiltSolid hexagonal_prism_solid(double length);  // height over the edge of the hexagon

/// Intersection of half-spaces with normals spread over the sphere and shaken, at distances from the centre drawn
/// evenly from 1 - spread to 1.
BuiltSolid crushed_rock_solid(int facets, double spread, std::uint64_t seed);

}  // namespace shape_pipeline
