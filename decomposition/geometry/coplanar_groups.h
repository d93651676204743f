// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "decomposition/geometry/vector3.h"

namespace decomposition {

/// Connected triangles in one plane.
struct CoplanarGroups {
  std::vector<int> group_of;  // (n_faces)
  std::vector<Plane> planes;  // (n_groups) of the group's largest triangle
  std::vector<double> areas;  // (n_groups)
  int count() const { return static_cast<int>(planes.size()); }
};

/// Grows groups from the largest triangles over shared edges while all corners stay within `tolerance` [m] of the first
/// triangle's plane and the normals agree. Stops, with faces left in no group (-1), once there are more than `most`.
CoplanarGroups coplanar_groups(const std::vector<Vec3>& vertices, const std::vector<std::array<int, 3>>& faces,
                               double tolerance, int most = std::numeric_limits<int>::max());

/// Face on the other side of each edge (edge k runs from corner k to k + 1), -1 where there is none.
std::vector<std::array<int, 3>> face_neighbours(const std::vector<std::array<int, 3>>& faces);

}  // namespace decomposition
