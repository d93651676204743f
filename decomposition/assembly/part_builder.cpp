// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/assembly/part_builder.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "catalog/mass_properties.h"
#include "decomposition/geometry/convex_polygon.h"
#include "decomposition/geometry/faceted_hull.h"

namespace decomposition {
namespace {

// All shares of the part's size (diagonal of its bounding box).
constexpr double kOnPlane = 1e-12;          // a snapped point is this near its cut planes
constexpr double kCoplanar = 2e-10;         // triangles this flat become one polygon; promised: planar to 1e-9
constexpr int kDirectionRounds = 2000;      // to find a way off all planes; three or four do for planes at fair angles
constexpr double kStandsOut = 1e-7;         // a corner of a cut polygon stands out at least this far
constexpr double kFlattestTriangle = 1e-5;  // below this height a triangle has no safe normal: its apex goes

/// Least move that puts p on all planes, by Kaczmarz sweeps; false if they have no common point near by.
bool put_on(Vec3& p, const std::vector<Plane>& planes, double size) {
  for (int sweep = 0; sweep < 300; ++sweep) {
    double farthest = 0;
    for (const Plane& plane : planes) {
      const double distance = plane.signed_distance(p);
      farthest = std::fmax(farthest, std::abs(distance));
      p -= distance * plane.normal;
    }
    if (farthest <= 0.1 * kOnPlane * size) return true;
  }
  return false;
}

/// p on the cut planes it is near; if they are too nearly parallel to meet, on the nearest only.
Vec3 snapped(Vec3 p, const std::vector<Plane>& planes, double snap_distance, double size) {
  for (int round = 0; round < 4; ++round) {
    std::vector<Plane> near;
    for (const Plane& plane : planes)
      if (plane.signed_distance(p) > -snap_distance) near.push_back(plane);
    if (near.empty()) return p;
    std::sort(near.begin(), near.end(), [&](const Plane& a, const Plane& b) {
      return std::abs(a.signed_distance(p)) < std::abs(b.signed_distance(p));
    });
    Vec3 moved = p;
    while (!near.empty() && !(put_on(moved = p, near, size) && norm(moved - p) < 10 * snap_distance)) near.pop_back();
    const bool is_settled = norm(moved - p) <= kOnPlane * size;
    p = moved;
    if (is_settled) break;
  }
  return p;
}

/// Drops points on a cut plane that are no corners of the polygon they span there.
std::vector<Vec3> without_flat_points(const std::vector<Vec3>& points, const std::vector<Plane>& planes, double size) {
  std::vector<char> is_kept(points.size(), 1);
  for (const Plane& plane : planes) {
    Vec3 u, v;
    plane_axes(plane.normal, u, v);
    std::vector<Point2> flat;
    std::vector<std::size_t> index;
    for (std::size_t p = 0; p < points.size(); ++p)
      if (is_kept[p] && std::abs(plane.signed_distance(points[p])) <= kOnPlane * size) {
        flat.push_back({dot(u, points[p]), dot(v, points[p])});
        index.push_back(p);
      }
    if (flat.size() < 3) continue;
    for (const std::size_t p : index) is_kept[p] = 0;
    for (const int corner : convex_hull(flat, kStandsOut * size)) is_kept[index[static_cast<std::size_t>(corner)]] = 1;
  }
  std::vector<Vec3> kept;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (is_kept[p]) kept.push_back(points[p]);
  return kept;
}

/// Apexes of triangles that are too flat to have a safe normal.
std::set<int> sliver_apexes(const FacetedHull& hull, double size) {
  std::set<int> apexes;
  for (const Facet& facet : hull.facets) {
    if (facet.vertices.size() != 3) continue;
    const auto at = [&](std::size_t k) { return hull.points[static_cast<std::size_t>(facet.vertices[k % 3])]; };
    const double twice_area = norm(cross(at(1) - at(0), at(2) - at(0)));
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (norm(at(k + 1) - at(k)) > norm(at(longest + 1) - at(longest))) longest = k;
    if (twice_area < kFlattestTriangle * size * norm(at(longest + 1) - at(longest)))
      apexes.insert(facet.vertices[(longest + 2) % 3]);
  }
  return apexes;
}

BuiltPart to_part(const FacetedHull& hull, const Cell& cell) {
  BuiltPart built;
  built.cell = cell;
  for (const Vec3& p : hull.points) built.part.vertices.push_back(to_point(p));
  for (const Facet& facet : hull.facets) {
    catalog::ConvexFace face;
    face.vertices = facet.vertices;
    std::rotate(face.vertices.begin(), std::min_element(face.vertices.begin(), face.vertices.end()),
                face.vertices.end());
    face.plane = {to_point(facet.plane.normal), facet.plane.offset};
    built.part.faces.push_back(std::move(face));
    built.face_cut.push_back(facet.given_plane < 0 ? -1 : cell.cuts[static_cast<std::size_t>(facet.given_plane)]);
  }
  return built;
}

/// Vertices of which one must go for the rules' sake; none if the part keeps to them.
std::vector<int> breaching_vertices(const catalog::ConvexPart& part, const PartRules& rules) {
  std::vector<int> all(part.vertices.size());
  std::iota(all.begin(), all.end(), 0);
  const bool is_over_cap = static_cast<int>(part.vertex_count()) > rules.vertices ||
                           (rules.faces > 0 && static_cast<int>(part.face_count()) > rules.faces);
  if (is_over_cap) return all;
  const auto at = [&](int v) { return to_vec3(part.vertices[static_cast<std::size_t>(v)]); };
  double size = 0;
  for (const int v : all)
    for (const int w : all) size = std::fmax(size, norm(at(v) - at(w)));
  for (const catalog::ConvexFace& face : part.faces) {
    double width = size;
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const int a = face.vertices[k], b = face.vertices[(k + 1) % face.vertices.size()];
      const Vec3 edge = at(b) - at(a);
      if (norm(edge) < rules.shortest_edge * size) return {a, b};
      double reach = 0;
      for (const int v : face.vertices) reach = std::fmax(reach, norm(cross(edge, at(v) - at(a))) / norm(edge));
      width = std::fmin(width, reach);
    }
    if (width < rules.narrowest_face * size) return face.vertices;
  }
  return {};
}

double volume_of(const catalog::ConvexPart& part) {
  return catalog::volume_moments(catalog::triangulated(part)).volume;
}

}  // namespace

int exact_side(const Plane& plane, const Vec3& p) {
  __extension__ typedef __float128 Quad;
  const Quad value = static_cast<Quad>(plane.normal.x) * p.x + static_cast<Quad>(plane.normal.y) * p.y +
                     static_cast<Quad>(plane.normal.z) * p.z - plane.offset;
  return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

Vec3 nudged_inside(const Vec3& p, const std::vector<Plane>& planes, double distance, const Vec3& inside) {
  Vec3 inward;
  std::vector<const Plane*> near;
  for (const Plane& plane : planes)
    if (plane.signed_distance(p) > -distance) near.push_back(&plane);
  // A direction that leads away from all of them: repeatedly add the normal of the plane it leaves slowest.
  bool is_off_all = near.empty();
  for (int round = 0; round < kDirectionRounds && !near.empty(); ++round) {
    const Plane* worst = *std::min_element(near.begin(), near.end(), [&](const Plane* a, const Plane* b) {
      return -dot(a->normal, inward) < -dot(b->normal, inward);
    });
    is_off_all = -dot(worst->normal, inward) >= 1;
    if (is_off_all) break;
    inward -= (1.2 + dot(worst->normal, inward)) * worst->normal;
  }
  const double unit = std::numeric_limits<double>::epsilon() *
                      std::fmax(std::fmax(std::abs(p.x), std::abs(p.y)), std::fmax(std::abs(p.z), distance));
  // Between planes at tiny angles, of plates: towards the inside, which all of them allow.
  if (!is_off_all) inward = normalized(inside - p);
  Vec3 moved = p;
  for (double step = unit;
       std::any_of(near.begin(), near.end(), [&](const Plane* plane) { return exact_side(*plane, moved) > 0; });
       step *= 1.5)
    moved = p + step * inward;
  return moved;
}

std::optional<BuiltPart> build_part(const std::vector<Vec3>& points, const Cell& cell, double snap_distance) {
  const double size = bounding_box(points).diagonal();
  std::vector<Vec3> placed;
  for (const Vec3& p : points) {
    const Vec3 on_planes = snapped(p, cell.planes, snap_distance, size);
    const bool is_new = std::none_of(placed.begin(), placed.end(),
                                     [&](const Vec3& other) { return norm(other - on_planes) < kStandsOut * size; });
    if (is_new) placed.push_back(on_planes);
  }
  placed = without_flat_points(placed, cell.planes, size);
  Vec3 middle;
  for (const Vec3& p : placed) middle += (1.0 / static_cast<double>(placed.size())) * p;
  for (Vec3& p : placed) p = nudged_inside(p, cell.planes, kOnPlane * size, middle);
  while (placed.size() >= 4) {
    const auto hull = faceted_hull(placed, cell.planes, kCoplanar * size);
    if (!hull) return std::nullopt;
    const std::set<int> apexes = sliver_apexes(*hull, size);
    if (apexes.empty()) return to_part(*hull, cell);
    placed.clear();
    for (std::size_t v = 0; v < hull->points.size(); ++v)
      if (static_cast<int>(v) != *apexes.begin()) placed.push_back(hull->points[v]);
  }
  return std::nullopt;
}

std::optional<BuiltPart> build_part_by_rules(const std::vector<Vec3>& points, const Cell& cell, double snap_distance,
                                             const PartRules& rules) {
  std::optional<BuiltPart> built = build_part(points, cell, snap_distance);
  while (built) {
    const std::vector<int> breaching = breaching_vertices(built->part, rules);
    if (breaching.empty()) return built;
    std::optional<BuiltPart> best;
    for (const int without : breaching) {
      std::vector<Vec3> rest;
      for (std::size_t v = 0; v < built->part.vertices.size(); ++v)
        if (static_cast<int>(v) != without) rest.push_back(to_vec3(built->part.vertices[v]));
      std::optional<BuiltPart> next = build_part(rest, cell, 0);
      if (next && (!best || volume_of(next->part) > volume_of(best->part))) best = std::move(next);
    }
    built = std::move(best);
  }
  return built;
}

}  // namespace decomposition
