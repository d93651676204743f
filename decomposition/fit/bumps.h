// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "decomposition/solid/solid.h"

namespace decomposition {

/// At most `count` places half-way up the rock that stands out of a polyhedron's faces, most volume first: where a
/// vertex that fell inside is of use. Faces for which `is_skipped` holds do not count, nor what lies beyond `cell`:
/// that is another part's. `margin` [m] is kept from the cell's planes.
template <class IsSkipped>
std::vector<Vec3> bump_places(const Solid& solid, const std::vector<Vec3>& points,
                              const std::vector<std::array<int, 3>>& faces, const std::vector<Plane>& cell,
                              double margin, std::size_t count, const IsSkipped& is_skipped) {
  constexpr double kHighest = 0.06;  // share of the diagonal
  struct Bump {
    double volume;
    Vec3 place;
  };
  std::vector<Bump> bumps;
  const double rise = solid.cell();
  for (const auto& face : faces) {
    if (is_skipped(face)) continue;
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(face[k])]; };
    const Vec3 area_normal = 0.5 * cross(at(1) - at(0), at(2) - at(0));
    const double area = norm(area_normal);
    const Vec3 middle = (1 / 3.0) * (at(0) + at(1) + at(2));
    double highest = kHighest * solid.diagonal();
    for (const Plane& plane : cell)
      if (const double slope = dot(plane.normal, area_normal) / area; slope > 0)
        highest = std::fmin(highest, -plane.signed_distance(middle) / slope - margin);
    if (!(highest >= rise)) continue;
    double height = 0;
    while (height + rise < highest && solid.occupancy(middle + ((height + rise) / area) * area_normal) > 0.5)
      height += rise;
    height = std::fmax(height, 0.1 * rise);
    bumps.push_back({area * height, middle + (0.5 * height / area) * area_normal});
  }
  count = std::min(count, bumps.size());
  std::partial_sort(bumps.begin(), bumps.begin() + static_cast<std::ptrdiff_t>(count), bumps.end(),
                    [](const Bump& a, const Bump& b) { return a.volume > b.volume; });
  std::vector<Vec3> places;
  for (std::size_t k = 0; k < count; ++k) places.push_back(bumps[k].place);
  return places;
}

}  // namespace decomposition
