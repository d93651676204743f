// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/scene.h"

namespace benchmark_scenes {

dem_gpu::Shape cube(double edge);

/// Four hexagons and four triangles, all edges alike; volume [m3].
dem_gpu::Shape truncated_tetrahedron(double volume);

/// Three cubes in the xy plane, one part each.
dem_gpu::Shape three_cube_l(double edge);

/// Cross of five squares `edge` wide in the xy plane, `edge` thick, of four parts: its middle is one with an arm.
dem_gpu::Shape four_part_cross(double edge);

/// Ball-like rough rock of 4 or 8 parts that meet at a point within, not convex as a whole: its corners stand off an
/// ellipsoid of axes 1 : 0.85 : 0.7 by up to 8 %, by the seed, and those of 8 parts have valleys along their seams.
/// `diameter`: of the sphere of its volume [m]. Throws catalog::InputError for another number of parts.
dem_gpu::Shape rough_rock(int parts, double diameter, std::uint64_t seed);

/// Convex, about a ball: the hull of `corners` points spread evenly on a sphere; 2 * corners - 4 faces as a rule.
/// `diameter`: of the sphere of its volume [m].
dem_gpu::Shape faceted_ball(int corners, double diameter);

}  // namespace benchmark_scenes
