// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/exact_piece.h"

#include <algorithm>

#include "decomposition/geometry/convex_polygon.h"
#include "decomposition/geometry/faceted_hull.h"

namespace decomposition {
namespace {

// Share of the diagonal within which a point counts as lying on a plane. The faces of a part must be planar to 1e-9.
constexpr double kOnPlane = 1e-10;
// Clipped triangles below this share of the diagonal squared only touch the cell.
constexpr double kTouchingArea = 1e-13;
constexpr std::size_t kMostPoints = 400;   // more can hardly be the hull of at most 64 corners
constexpr double kVolumeAgreement = 0.03;  // columns against hull: only a safety net, columns are coarse

double polygon_area(const std::vector<Vec3>& polygon) {
  Vec3 twice;
  for (std::size_t k = 2; k < polygon.size(); ++k) twice += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return norm(twice) / 2;
}

bool lies_on(const std::vector<Vec3>& polygon, const Plane& plane, double tolerance) {
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const Vec3& p) { return std::abs(plane.signed_distance(p)) <= tolerance; });
}

/// The solid's surface inside the cell, polygon by polygon. What lies in a cut plane with its rock on the other side is
/// no part of this piece.
std::vector<std::vector<Vec3>> surface_inside(const Solid& solid, const std::vector<Plane>& cell, double tolerance) {
  std::vector<std::vector<Vec3>> surface;
  for (const catalog::Triangle& face : solid.faces()) {
    std::vector<Vec3> polygon;
    for (const int v : face) polygon.push_back(solid.vertices()[static_cast<std::size_t>(v)]);
    const Vec3 normal = cross(polygon[1] - polygon[0], polygon[2] - polygon[0]);
    polygon = clip(std::move(polygon), cell);
    if (polygon_area(polygon) < kTouchingArea * solid.diagonal() * solid.diagonal()) continue;
    if (std::any_of(cell.begin(), cell.end(), [&](const Plane& plane) {
          return dot(normal, plane.normal) < 0 && lies_on(polygon, plane, tolerance);
        }))
      continue;
    surface.push_back(std::move(polygon));
  }
  return surface;
}

/// A quick no: a convex piece has no re-entrant edge in its cell's inside.
bool has_reentrant_edge_inside(const Solid& solid, const std::vector<Plane>& cell, double tolerance) {
  return std::any_of(solid.reentrant_edges().begin(), solid.reentrant_edges().end(), [&](const auto& edge) {
    double first = 0, last = 1;  // stretch of the edge well inside the cell
    for (const Plane& plane : cell) {
      const double from = plane.signed_distance(edge[0]) + 10 * tolerance,
                   to = plane.signed_distance(edge[1]) + 10 * tolerance;
      if (from >= 0 && to >= 0) return false;
      if (from > 0) first = std::fmax(first, from / (from - to));
      if (to > 0) last = std::fmin(last, from / (from - to));
    }
    return last > first;
  });
}

/// Corners of the cell itself (three planes) that lie in the solid.
std::vector<Vec3> cell_corners_inside(const Solid& solid, const std::vector<Plane>& cell, double tolerance) {
  std::vector<Vec3> corners;
  for (std::size_t a = 0; a < cell.size(); ++a)
    for (std::size_t b = a + 1; b < cell.size(); ++b)
      for (std::size_t c = b + 1; c < cell.size(); ++c) {
        const Vec3 bc = cross(cell[b].normal, cell[c].normal), ca = cross(cell[c].normal, cell[a].normal),
                   ab = cross(cell[a].normal, cell[b].normal);
        const double determinant = dot(cell[a].normal, bc);
        if (std::abs(determinant) < 1e-6) continue;
        const Vec3 p = (1 / determinant) * (cell[a].offset * bc + cell[b].offset * ca + cell[c].offset * ab);
        const bool is_in_cell = std::all_of(cell.begin(), cell.end(),
                                            [&](const Plane& plane) { return plane.signed_distance(p) <= tolerance; });
        if (is_in_cell && solid.occupancy(p) > 0.9) corners.push_back(p);
      }
  return corners;
}

/// Corners of the hull of the piece and of what of the surface bounds it.
struct PieceHull {
  std::optional<FacetedHull> hull;
  std::vector<std::vector<Vec3>> surface;
};

/// No hull for pieces that would break the caps.
PieceHull hull_of_piece(const Solid& solid, const std::vector<Plane>& cell, const ExactCaps& caps, double tolerance) {
  PieceHull piece;
  piece.surface = surface_inside(solid, cell, tolerance);
  std::vector<Vec3> points = cell_corners_inside(solid, cell, tolerance);
  for (const std::vector<Vec3>& polygon : piece.surface) points.insert(points.end(), polygon.begin(), polygon.end());
  if (!cell.empty() && points.size() > 8 * kMostPoints) return piece;
  piece.hull = faceted_hull(points, cell, tolerance);
  if (piece.hull && (static_cast<int>(piece.hull->points.size()) > caps.vertices ||
                     (caps.faces > 0 && static_cast<int>(piece.hull->facets.size()) > caps.faces)))
    piece.hull.reset();
  return piece;
}

}  // namespace

std::vector<Vec3> capped_hull(const Solid& solid, const std::vector<Plane>& cell, const ExactCaps& caps) {
  if (!solid.is_faceted()) return {};
  const PieceHull piece = hull_of_piece(solid, cell, caps, kOnPlane * solid.diagonal());
  return piece.hull ? piece.hull->points : std::vector<Vec3>{};
}

std::optional<ExactPiece> exact_piece(const Solid& solid, const std::vector<Plane>& cell, const ExactCaps& caps) {
  if (!solid.is_faceted()) return std::nullopt;
  const double tolerance = kOnPlane * solid.diagonal();
  if (has_reentrant_edge_inside(solid, cell, tolerance)) return std::nullopt;
  const auto [hull, surface] = hull_of_piece(solid, cell, caps, tolerance);
  if (!hull) return std::nullopt;
  // The piece is its own hull if no surface runs through the hull's inside.
  for (const std::vector<Vec3>& polygon : surface)
    if (std::none_of(hull->facets.begin(), hull->facets.end(),
                     [&](const Facet& facet) { return lies_on(polygon, facet.plane, 10 * tolerance); }))
      return std::nullopt;
  ExactPiece piece{hull->points, 0, solid.diagonal()};
  for (const Facet& facet : hull->facets) {
    const Vec3 a = hull->points[static_cast<std::size_t>(facet.vertices[0])] - hull->points[0];
    for (std::size_t k = 2; k < facet.vertices.size(); ++k)
      piece.volume += dot(a, cross(hull->points[static_cast<std::size_t>(facet.vertices[k - 1])] - hull->points[0],
                                   hull->points[static_cast<std::size_t>(facet.vertices[k])] - hull->points[0])) /
                      6;
    double deepest = 0;
    for (const Vec3& p : hull->points) deepest = std::fmax(deepest, -facet.plane.signed_distance(p));
    piece.thickness = std::fmin(piece.thickness, deepest);
  }
  if (std::abs(solid.volume_inside(cell) / piece.volume - 1) > kVolumeAgreement) return std::nullopt;
  return piece;
}

}  // namespace decomposition
