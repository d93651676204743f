// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/scene.h"

namespace dem_gpu {

/// Component along x, y or z (0, 1, 2).
inline Real component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// From where to where something reaches along an axis [m]; the lowest above the highest number where it is endless.
struct Extent {
  Real low, high;
};

/// Of a wall's surface at time 0. A plane has none and is not asked for.
Extent extent_at_start(const Wall& wall, int axis);

/// How far a wall's motion shifts it along the axis up to time `until`, lowest and highest; turning left out.
Extent shift_range(const Motion& motion, int axis, Real until);

/// All that a wall's surface reaches up to time `until`, turning included: never less than the truth, and more by at
/// most 0.13 % of the radius of a round wall that turns. Where a wall both rotates and swings: as if it turned any way.
Extent swept_extent(const Wall& wall, int axis, Real until);

}  // namespace dem_gpu
