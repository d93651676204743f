// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "catalog/mass_properties.h"
#include "tests/support/dem_scenes.h"

namespace test_support {

/// Block with a right-angled groove along y in its underside, cut at the groove's edge and `slices` times along it.
inline std::vector<catalog::ConvexPart> grooved_block(int slices) {
  const double width = 0.02, groove = 0.015, height = 0.03, length = 0.04;
  std::vector<catalog::ConvexPart> parts;
  for (const double side : {-1.0, 1.0})
    for (int slice = 0; slice < slices; ++slice) {
      const double from = length * slice / slices, to = length * (slice + 1) / slices;
      const std::vector<std::array<double, 2>> outline{
          {side * width, 0}, {side * groove, 0}, {0, groove}, {0, height}, {side * width, height}};
      std::vector<Vec3> vertices;
      for (const double y : {from, to})
        for (const auto& corner : outline) vertices.push_back({corner[0], y, corner[1]});
      std::vector<std::vector<int>> loops{{0, 1, 2, 3, 4}, {9, 8, 7, 6, 5}};
      for (int k = 0; k < 5; ++k) loops.push_back({k, k + 5, (k + 1) % 5 + 5, (k + 1) % 5});
      if (side > 0)
        for (auto& loop : loops) std::reverse(loop.begin(), loop.end());
      catalog::ConvexPart part = part_of(vertices, loops);
      if (slice > 0) part.faces[0].kind = catalog::FaceKind::inner;
      if (slice + 1 < slices) part.faces[1].kind = catalog::FaceKind::inner;
      part.faces[4].kind = catalog::FaceKind::inner;  // at the groove's edge
      parts.push_back(std::move(part));
    }
  return parts;
}

/// Shape symmetric about the planes x = 0 and y = 0 of its parts' frame, which becomes its body frame but for the
/// height of the centre.
inline dem_gpu::Shape symmetric_shape(std::vector<catalog::ConvexPart> parts) {
  catalog::VolumeMoments moments;
  for (const auto& part : parts) moments += catalog::volume_moments(catalog::triangulated(part));
  const catalog::MassProperties mass = catalog::mass_properties(moments);
  for (auto& part : parts) part = moved_part(part, {}, {0, 0, -mass.centroid[2]});
  double inertia[3] = {0, 0, 0};
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 3; ++k)
      inertia[axis] += mass.principal_inertia[k] * mass.principal_axes[k][axis] * mass.principal_axes[k][axis];
  return {"block", dem_gpu::PolyhedralShape{parts}, mass.volume, {inertia[0], inertia[1], inertia[2]}};
}

/// Prism with a right-angled ridge along the y axis through the origin.
inline catalog::ConvexPart roof_part() {
  return part_of(
      {{-0.1, -0.3, -0.1}, {0.1, -0.3, -0.1}, {0, -0.3, 0}, {-0.1, 0.3, -0.1}, {0.1, 0.3, -0.1}, {0, 0.3, 0}},
      {{0, 1, 2}, {5, 4, 3}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}});
}

}  // namespace test_support
