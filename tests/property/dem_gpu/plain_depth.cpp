// SPDX-License-Identifier: Apache-2.0
#include "tests/property/dem_gpu/plain_depth.h"

#include <vector>

#include "tests/support/dem_scenes.h"

namespace plain {
namespace {

using dem_gpu::Vec3;
using test_support::to_vec3;

using Corners = std::vector<Vec3>;

/// depth(x) = offset - normal . x
struct Depth {
  Vec3 normal;
  double offset = 0;

  double at(const Vec3& x) const { return offset - dot(normal, x); }
};
Depth operator-(const Depth& a, const Depth& b) { return {a.normal - b.normal, a.offset - b.offset}; }

struct Face {
  Corners corners;
  Depth depth;
};

/// World axes about `origin`.
std::vector<Face> faces_of(const Body& body, const Vec3& origin) {
  const Vec3 shift = body.pose.position - origin;
  std::vector<Face> faces;
  for (const catalog::ConvexFace& face : body.part.faces) {
    Face placed;
    for (const int v : face.vertices)
      placed.corners.push_back(body.pose.scale * rotate(body.pose.orientation, to_vec3(body.part.vertices[v])) + shift);
    placed.depth.normal = rotate(body.pose.orientation, to_vec3(face.plane.normal));
    placed.depth.offset = body.pose.scale * face.plane.offset + dot(placed.depth.normal, shift);
    faces.push_back(std::move(placed));
  }
  return faces;
}

/// Where the depth is not negative.
Corners clipped(const Corners& polygon, const Depth& depth) {
  Corners kept;
  for (std::size_t c = 0; c < polygon.size(); ++c) {
    const Vec3 &here = polygon[c], &next = polygon[(c + 1) % polygon.size()];
    const double at_here = depth.at(here), at_next = depth.at(next);
    if (at_here >= 0) kept.push_back(here);
    if ((at_here > 0 && at_next < 0) || (at_here < 0 && at_next > 0))
      kept.push_back(here + (at_here / (at_here - at_next)) * (next - here));
  }
  return kept;
}

/// Adds the integral of psi over a polygon of outward normal n, along `sign` n; the midpoints of a triangle's edges
/// integrate a quadratic exactly.
void add_polygon(const Corners& polygon, const Vec3& normal, const Depth& depth, double rate, double sign,
                 DepthForce& sum) {
  for (std::size_t c = 2; c < polygon.size(); ++c) {
    const Vec3 triangle[] = {polygon[0], polygon[c - 1], polygon[c]};
    const double area = dot(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]), normal) / 2;
    for (int edge = 0; edge < 3; ++edge) {
      const Vec3 middle = 0.5 * (triangle[edge] + triangle[(edge + 1) % 3]);
      const double d = depth.at(middle), psi = area / 3 * d * (1 + rate * d);
      sum.force += (sign * psi) * normal;
      sum.torque += cross(middle, (sign * psi) * normal);
      sum.weight += psi;
      sum.slope += area / 3 * (1 + 2 * rate * d);
    }
  }
}

void add_surface(const std::vector<Face>& surface, const std::vector<Face>& solid, const Body& solid_body, double sign,
                 DepthForce& sum) {
  std::vector<Depth> depths{{Vec3{}, solid_body.cap}};
  for (const Face& face : solid) depths.push_back(face.depth);
  for (const Face& face : surface) {
    Corners inside = face.corners;
    for (const Face& plane : solid) inside = clipped(inside, plane.depth);
    for (const Depth& least : depths) {
      Corners piece = inside;
      for (const Depth& other : depths)
        if (&other != &least) piece = clipped(piece, other - least);
      add_polygon(piece, face.depth.normal, least, solid_body.rate, sign, sum);
    }
  }
}

}  // namespace

DepthForce depth_force(const Body& a, const Body& b) {
  const std::vector<Face> faces_a = faces_of(a, a.pose.position), faces_b = faces_of(b, a.pose.position);
  DepthForce sum;
  add_surface(faces_b, faces_a, a, 1, sum);
  add_surface(faces_a, faces_b, b, -1, sum);
  return sum;
}

}  // namespace plain
