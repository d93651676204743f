// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <random>
#include <vector>

#include "dem_gpu/overlap_probe.h"

namespace workflows {

/// A shape in the frame its parts are given in; for the overlap probe, which needs no inertia.
dem_gpu::Shape shape_as_given(const std::string& name, std::vector<catalog::ConvexPart> parts);

dem_gpu::Shape box_shape(const dem_gpu::Vec3& size);

/// The part moved by a vector.
catalog::ConvexPart shifted(catalog::ConvexPart part, const dem_gpu::Vec3& by);

/// Box centred at the origin, cut into `cuts[axis]` equal slabs along each axis; cut faces are inner.
dem_gpu::Shape cut_box_shape(const dem_gpu::Vec3& size, const std::array<int, 3>& cuts);

/// L of three unit squares in the xy plane, 1 high, its inner corner at the origin; as 2 or 3 boxes.
dem_gpu::Shape l_shape(int part_count);

/// Cross of five unit squares in the xy plane, 1 high, its middle at the origin; as 3 or 5 boxes.
dem_gpu::Shape cross_shape(int part_count);

/// Rough rock about the origin, about 1 in radius, of 32 tetrahedra that meet at its centre.
dem_gpu::Shape rough_rock_shape();

/// Two posts 0.3 wide and a bridge between them, 1 x 0.5 m, that stands 0.02 m above the posts' feet at z = -0.5 m.
dem_gpu::Shape bridge_shape();

/// Regular tetrahedron on four corners of the unit cube centred at the origin: those with xyz > 0.
dem_gpu::Shape tetrahedron_shape();

/// |x| + |y| + |z| <= 1.
dem_gpu::Shape octahedron_shape();

/// Uniform over rotations. Shoemake, Graphics Gems III (1992) 124-132.
dem_gpu::Quaternion random_rotation(std::mt19937_64& random);

/// Uniform over directions.
dem_gpu::Vec3 random_direction(std::mt19937_64& random);

/// In [low, high). Drawn from the bits themselves, so that every standard library gives the same poses.
double uniform(std::mt19937_64& random, double low, double high);

/// Distance of the two bodies' origins along `direction` at which they begin to touch, found by bisection up to `reach`
/// [m]; b stands at direction * distance.
double touch_distance(const dem_gpu::OverlapProbe& probe, const dem_gpu::PosePair& poses,
                      const dem_gpu::Vec3& direction, double reach);

}  // namespace workflows
