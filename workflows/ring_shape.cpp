// SPDX-License-Identifier: Apache-2.0
#include "workflows/ring_shape.h"

#include <cmath>
#include <numbers>

#include "catalog/input_error.h"

namespace workflows {
namespace {

using catalog::ConvexPart;
using catalog::FaceKind;
using dem_gpu::Vec3;

Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }

void add_face(ConvexPart& part, std::vector<int> corners, FaceKind kind) {
  const auto at = [&](std::size_t c) { return to_vec3(part.vertices[static_cast<std::size_t>(corners[c])]); };
  Vec3 area;
  for (std::size_t c = 2; c < corners.size(); ++c) area += cross(at(c - 1) - at(0), at(c) - at(0));
  const Vec3 normal = area / norm(area);
  part.faces.push_back({std::move(corners), {{normal.x, normal.y, normal.z}, 0}, kind});
  part.faces.back().plane.offset =
      dot(normal, to_vec3(part.vertices[static_cast<std::size_t>(part.faces.back().vertices[0])]));
}

/// Between the radial planes at two angles about z.
ConvexPart segment(const RingShape& ring, double from, double to) {
  ConvexPart part;
  const int sides = ring.sides;
  for (const double angle : {from, to})
    for (int i = 0; i < sides; ++i) {
      // A flat side, not a corner, faces the hole.
      const double turn = 2 * std::numbers::pi * (i + 0.5) / sides;
      const double radius = ring.diameter / 2 + ring.wire / 2 * std::cos(turn);
      part.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), ring.wire / 2 * std::sin(turn)});
    }
  std::vector<int> start, end;
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    add_face(part, {i, i + sides, next + sides, next}, FaceKind::outer);
    start.push_back(i);
    end.push_back(2 * sides - 1 - i);
  }
  add_face(part, start, FaceKind::inner);
  add_face(part, end, FaceKind::inner);
  return part;
}

}  // namespace

dem_gpu::Shape ring_shape(const std::string& name, const RingShape& ring) {
  if (!(ring.wire > 0 && ring.wire < ring.diameter / 2))
    throw catalog::InputError("ring '" + name + "': a wire of " + std::to_string(1e3 * ring.wire) +
                              " mm leaves no hole in a ring of " + std::to_string(1e3 * ring.diameter) +
                              " mm; use a wire of less than half the diameter");
  std::vector<ConvexPart> parts;
  for (int k = 0; k < ring.segments; ++k)
    parts.push_back(
        segment(ring, 2 * std::numbers::pi * k / ring.segments, 2 * std::numbers::pi * (k + 1) / ring.segments));
  return dem_gpu::polyhedral_shape(name, parts);
}

}  // namespace workflows
