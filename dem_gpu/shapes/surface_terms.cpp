// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/shapes/surface_terms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dem_gpu {
namespace {

/// Edges and planes nearer than this share of the body's size are one: above the rounding of stored shapes, far below
/// any feature.
constexpr Real kTouching = 1e-9;

struct OuterPolygon {
  std::size_t part;
  std::vector<Vec3> corners;  // counter-clockwise seen from outside
  HalfSpace plane;
};

std::vector<OuterPolygon> outer_polygons(const std::vector<catalog::ConvexPart>& parts) {
  std::vector<OuterPolygon> polygons;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const catalog::ConvexFace& face : parts[p].faces) {
      if (face.kind != catalog::FaceKind::outer) continue;
      const auto to_vec3 = [](const catalog::Point& q) { return Vec3{q[0], q[1], q[2]}; };
      OuterPolygon& polygon =
          polygons.emplace_back(OuterPolygon{p, {}, {to_vec3(face.plane.normal), face.plane.offset}});
      for (const int vertex : face.vertices)
        polygon.corners.push_back(to_vec3(parts[p].vertices[static_cast<std::size_t>(vertex)]));
    }
  return polygons;
}

/// True if two segments share a piece longer than the tolerance.
bool share_a_piece(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Real tolerance) {
  const Real length = norm(b - a);
  if (length <= tolerance) return false;
  const Vec3 along = (b - a) / length;
  const auto off_line = [&](const Vec3& x) { return norm((x - a) - dot(x - a, along) * along); };
  if (off_line(c) > tolerance || off_line(d) > tolerance) return false;
  const Real from = dot(c - a, along), to = dot(d - a, along);
  return std::min(length, std::max(from, to)) - std::max(Real(0), std::min(from, to)) > tolerance;
}

bool share_an_edge(const OuterPolygon& g, const OuterPolygon& j, Real tolerance) {
  for (std::size_t e = 0; e < g.corners.size(); ++e)
    for (std::size_t f = 0; f < j.corners.size(); ++f)
      if (share_a_piece(g.corners[e], g.corners[(e + 1) % g.corners.size()], j.corners[f],
                        j.corners[(f + 1) % j.corners.size()], tolerance))
        return true;
  return false;
}

/// True if no corner lies deeper below the plane than the tolerance.
bool lies_in_front(const OuterPolygon& polygon, const HalfSpace& plane, Real tolerance) {
  return std::all_of(polygon.corners.begin(), polygon.corners.end(),
                     [&](const Vec3& corner) { return depth_below(plane, corner) <= tolerance; });
}

/// Bounding boxes tell most pairs apart.
struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  explicit Box(const OuterPolygon& polygon) {
    for (const Vec3& c : polygon.corners) {
      low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
      high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
    }
  }
  bool touches(const Box& b, Real tolerance) const {
    return low.x <= b.high.x + tolerance && b.low.x <= high.x + tolerance && low.y <= b.high.y + tolerance &&
           b.low.y <= high.y + tolerance && low.z <= b.high.z + tolerance && b.low.z <= high.z + tolerance;
  }
};

/// Which polygons make one flat face, and which planes rise from the re-entrant edges of that face.
struct FlatFaces {
  std::vector<std::size_t> face;                     // of each polygon: the index of one of its polygons
  std::vector<std::vector<std::size_t>> risen_from;  // of each face: polygons across its re-entrant edges

  std::size_t root(std::size_t polygon) {
    while (face[polygon] != polygon) polygon = face[polygon] = face[face[polygon]];
    return polygon;
  }
};

FlatFaces flat_faces(const std::vector<OuterPolygon>& polygons, Real size) {
  const Real tolerance = kTouching * size;
  const std::vector<Box> boxes(polygons.begin(), polygons.end());
  FlatFaces flat{std::vector<std::size_t>(polygons.size()), std::vector<std::vector<std::size_t>>(polygons.size())};
  std::iota(flat.face.begin(), flat.face.end(), std::size_t{0});
  std::vector<std::pair<std::size_t, std::size_t>> reentrant;
  for (std::size_t g = 0; g < polygons.size(); ++g)
    for (std::size_t j = 0; j < g; ++j) {
      if (!boxes[g].touches(boxes[j], tolerance)) continue;
      const bool is_flat = is_same_plane(polygons[g].plane, polygons[j].plane, size);
      const bool is_reentrant = !is_flat && lies_in_front(polygons[g], polygons[j].plane, tolerance) &&
                                lies_in_front(polygons[j], polygons[g].plane, tolerance);
      if (!(is_flat || is_reentrant) || !share_an_edge(polygons[g], polygons[j], tolerance)) continue;
      if (is_flat)
        flat.face[flat.root(g)] = flat.root(j);
      else
        reentrant.insert(reentrant.end(), {{g, j}, {j, g}});
    }
  for (const auto& [g, j] : reentrant) flat.risen_from[flat.root(g)].push_back(j);
  return flat;
}

/// The plane at right angles to the polygon's through each edge, and at each sharp corner the one across its bisector:
/// neighbouring normals are then at most a right angle apart, which keeps the term above 1 / sqrt(3) of the distance.
void add_rim_planes(const OuterPolygon& polygon, Real tolerance, GreatestDepth& planes) {
  std::vector<Vec3> corners, inward;  // of the edge that begins at each corner
  for (std::size_t c = 0; c < polygon.corners.size(); ++c) {
    const Vec3 a = polygon.corners[c], along = polygon.corners[(c + 1) % polygon.corners.size()] - a;
    if (norm(along) <= tolerance) continue;
    corners.push_back(a);
    inward.push_back(cross(polygon.plane.normal, along) / norm(along));
    planes.push_back({inward.back(), dot(inward.back(), a)});
  }
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Vec3 &before = inward[(c + inward.size() - 1) % inward.size()], &after = inward[c];
    if (dot(before, after) >= 0) continue;
    const Vec3 bisector = unit_or(before + after, after);
    planes.push_back({bisector, dot(bisector, corners[c])});
  }
}

}  // namespace

bool is_same_plane(const HalfSpace& a, const HalfSpace& b, Real size) {
  return norm(a.normal - b.normal) < 1e-9 && std::abs(a.offset - b.offset) < 1e-9 * size;
}

Real greatest_depth(const GreatestDepth& planes, const Vec3& x) {
  Real greatest = -std::numeric_limits<Real>::max();
  for (const HalfSpace& plane : planes) greatest = std::max(greatest, depth_below(plane, x));
  return greatest;
}

std::vector<SurfaceTerm> surface_terms(const std::vector<catalog::ConvexPart>& parts, Real size) {
  const std::vector<OuterPolygon> polygons = outer_polygons(parts);
  FlatFaces flat = flat_faces(polygons, size);
  std::vector<SurfaceTerm> terms;
  for (std::size_t g = 0; g < polygons.size(); ++g) {
    const OuterPolygon& own = polygons[g];
    SurfaceTerm term{own.part, {own.plane, {-own.plane.normal, -own.plane.offset}}, 0};
    add_rim_planes(own, kTouching * size, term.planes);
    for (const std::size_t j : flat.risen_from[flat.root(g)]) {
      const HalfSpace& plane = polygons[j].plane;
      const bool is_known =
          std::any_of(term.planes.end() - static_cast<std::ptrdiff_t>(term.reentrant), term.planes.end(),
                      [&](const HalfSpace& known) { return is_same_plane(known, plane, size); });
      if (is_known || !lies_in_front(own, plane, kTouching * size)) continue;
      term.planes.push_back(plane);
      ++term.reentrant;
    }
    terms.push_back(std::move(term));
  }
  return terms;
}

}  // namespace dem_gpu
