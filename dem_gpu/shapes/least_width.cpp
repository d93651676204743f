// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/shapes/least_width.h"

#include <algorithm>
#include <limits>

namespace dem_gpu {
namespace {

Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }

Real width_along(const PolyhedralShape& polyhedron, const Vec3& direction) {
  Real low = std::numeric_limits<Real>::max(), high = -low;
  for (const catalog::ConvexPart& part : polyhedron.parts)
    for (const catalog::Point& vertex : part.vertices) {
      const Real position = dot(direction, to_vec3(vertex));
      low = std::min(low, position);
      high = std::max(high, position);
    }
  return high - low;
}

}  // namespace

Real least_width(const Shape& shape) {
  if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry)) return 2 * sphere->radius;
  const auto& polyhedron = std::get<PolyhedralShape>(shape.geometry);
  Real least = std::numeric_limits<Real>::max();
  for (const catalog::ConvexPart& part : polyhedron.parts)
    for (const catalog::ConvexFace& face : part.faces)
      if (face.kind == catalog::FaceKind::outer)
        least = std::min(least, width_along(polyhedron, to_vec3(face.plane.normal)));
  return least;
}

}  // namespace dem_gpu
