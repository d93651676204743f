// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/plain_overlap.h"

#include <vector>

namespace workflows {
namespace {

using dem_gpu::Vec3;

struct PlainFace {
  std::vector<Vec3> corners;
  Vec3 normal;  // outward, unit
  double offset = 0;
};

Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }

catalog::ConvexPart only_part(const dem_gpu::Shape& shape) {
  return std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts.at(0);
}

std::vector<PlainFace> faces_of(const catalog::ConvexPart& part, const dem_gpu::Quaternion& turn, const Vec3& shift) {
  std::vector<PlainFace> faces;
  for (const catalog::ConvexFace& face : part.faces) {
    PlainFace plain;
    for (const int vertex : face.vertices)
      plain.corners.push_back(rotate(turn, to_vec3(part.vertices[static_cast<std::size_t>(vertex)])) + shift);
    plain.normal = rotate(turn, to_vec3(face.plane.normal));
    plain.offset = dot(plain.normal, plain.corners[0]);
    faces.push_back(std::move(plain));
  }
  return faces;
}

std::vector<Vec3> clipped(std::vector<Vec3> polygon, const std::vector<PlainFace>& solid) {
  for (const PlainFace& plane : solid) {
    std::vector<Vec3> kept;
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      const Vec3 here = polygon[c], next = polygon[(c + 1) % polygon.size()];
      const double depth = plane.offset - dot(plane.normal, here), next_depth = plane.offset - dot(plane.normal, next);
      if (depth >= 0) kept.push_back(here);
      if ((depth > 0 && next_depth < 0) || (depth < 0 && next_depth > 0))
        kept.push_back(here + (depth / (depth - next_depth)) * (next - here));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

}  // namespace

PlainOverlap::PlainOverlap(const dem_gpu::Shape& a, const dem_gpu::Shape& b) : a_(only_part(a)), b_(only_part(b)) {}

PlainOverlap::Sums PlainOverlap::sums(const dem_gpu::PosePair& poses) const {
  const dem_gpu::Quaternion back = conjugate(poses.a.orientation);
  const std::vector<PlainFace> a = faces_of(a_, {}, {});
  const std::vector<PlainFace> b =
      faces_of(b_, back * poses.b.orientation, rotate(back, poses.b.position - poses.a.position));
  Sums sums;
  for (const bool is_a : {true, false})
    for (const PlainFace& face : is_a ? a : b) {
      const std::vector<Vec3> polygon = clipped(face.corners, is_a ? b : a);
      for (std::size_t c = 2; c < polygon.size(); ++c) {
        const Vec3 twice_area = cross(polygon[c - 1] - polygon[0], polygon[c] - polygon[0]);
        sums.volume += dot(twice_area, polygon[0]) / 6;
        if (!is_a) continue;
        sums.area += 0.5 * twice_area;
        sums.moment += cross(polygon[0] + polygon[c - 1] + polygon[c], twice_area) / 6;
      }
    }
  return sums;
}

}  // namespace workflows
