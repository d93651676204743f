// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/assembly/face_kinds.h"

#include <algorithm>
#include <limits>

#include "decomposition/geometry/convex_polygon.h"

namespace decomposition {
namespace {

constexpr double kReuseShare = 0.02;  // a split within this share of the face's size of a corner goes through it

/// Coordinates in the plane of a cut.
struct CutFrame {
  Vec3 u, v;
  explicit CutFrame(const Plane& cut) { plane_axes(cut.normal, u, v); }
  Point2 operator()(const catalog::Point& p) const { return {dot(u, to_vec3(p)), dot(v, to_vec3(p))}; }
};

Polygon2 outline(const CutFrame& frame, const catalog::ConvexPart& part, const catalog::ConvexFace& face) {
  Polygon2 polygon;
  for (const int v : face.vertices) polygon.push_back(frame(part.vertices[static_cast<std::size_t>(v)]));
  if (area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

/// One face on a cut: which part, which face of it.
struct CutFace {
  std::size_t part, face;
};

/// The faces on one cut, apart by side.
struct CutSides {
  std::vector<CutFace> faces[2];
};

CutSides faces_on(const std::vector<BuiltPart>& parts, int cut, const Plane& plane) {
  CutSides sides;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t f = 0; f < parts[p].face_cut.size(); ++f)
      if (parts[p].face_cut[f] == cut)
        sides.faces[dot(to_vec3(parts[p].part.faces[f].plane.normal), plane.normal) > 0 ? 0 : 1].push_back({p, f});
  return sides;
}

/// A line in the cut's plane: `side` is positive beyond it.
struct Line {
  Point2 normal;
  double offset;
  double side(const Point2& p) const { return normal[0] * p[0] + normal[1] * p[1] - offset; }
};

class FaceSplitter {
 public:
  FaceSplitter(BuiltPart& built, const CutFrame& frame, const SplitLimits& limits)
      : built_(built), frame_(frame), limits_(limits) {}

  /// Splits what stands out beyond the convex polygon `cover` off the face, largest piece first.
  void split_beyond(std::size_t face, const Polygon2& cover) {
    const double whole = area(outline(frame_, built_.part, built_.part.faces[face]));
    while (true) {
      const Polygon2 polygon = outline(frame_, built_.part, built_.part.faces[face]);
      double largest = limits_.smallest_ledge * whole;
      std::size_t chosen = cover.size();
      for (std::size_t k = 0; k < cover.size(); ++k) {
        const double beyond = area(polygon) - area(keep_behind(polygon, edge_line(cover, k)));
        if (beyond > largest) largest = beyond, chosen = k;
      }
      if (chosen == cover.size() || !split(face, edge_line(cover, chosen))) return;
    }
  }

 private:
  static Line edge_line(const Polygon2& polygon, std::size_t k) {
    const Point2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    const Point2 normal{(b[1] - a[1]) / length, (a[0] - b[0]) / length};
    return {normal, normal[0] * a[0] + normal[1] * a[1]};
  }

  static Polygon2 keep_behind(const Polygon2& polygon, const Line& line) {
    Polygon2 kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point2 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const double hp = line.side(p), hq = line.side(q);
      if (hp <= 0) kept.push_back(p);
      if ((hp < 0) != (hq < 0) && hp != hq)
        kept.push_back({p[0] + hp / (hp - hq) * (q[0] - p[0]), p[1] + hp / (hp - hq) * (q[1] - p[1])});
    }
    return kept;
  }

  /// Cuts the face in two along the line; false if that takes more vertices than there are or changes nothing.
  bool split(std::size_t face, const Line& line) {
    catalog::ConvexPart& part = built_.part;
    std::vector<int> polygon = part.faces[face].vertices;
    std::vector<double> height;
    double size = 0;
    for (const int v : polygon) {
      height.push_back(line.side(frame_(part.vertices[static_cast<std::size_t>(v)])));
      size = std::fmax(size, norm(at(v) - at(polygon[0])));
    }
    for (double& h : height)
      if (std::abs(h) < kReuseShare * size) h = 0;
    // What lies beyond must be one run of corners; `start` is the first of them.
    const std::size_t n = polygon.size();
    std::size_t start = n, runs = 0, run_length = 0;
    for (std::size_t k = 0; k < n; ++k) {
      run_length += height[k] > 0;
      if (height[k] > 0 && height[(k + n - 1) % n] <= 0) start = k, ++runs;
    }
    if (runs != 1 || std::none_of(height.begin(), height.end(), [](double h) { return h < 0; })) return false;
    const std::size_t end = (start + run_length) % n, before = (start + n - 1) % n, last = (end + n - 1) % n;
    if (static_cast<int>(part.faces.size()) >= limits_.faces) return false;
    const bool cuts_first = height[before] < 0, cuts_last = height[end] < 0;
    if (static_cast<int>(part.vertices.size()) + cuts_first + cuts_last > limits_.vertices) return false;
    const int entry =
        cuts_first ? add_vertex(polygon[before], polygon[start], share_along(height, before, start)) : polygon[before];
    const int leave =
        cuts_last ? add_vertex(polygon[last], polygon[end], share_along(height, last, end)) : polygon[end];
    std::vector<int> beyond{entry}, behind{leave};
    for (std::size_t k = 0; k < run_length; ++k) beyond.push_back(polygon[(start + k) % n]);
    beyond.push_back(leave);
    for (std::size_t k = 0; k < n - run_length; ++k)
      if (const int v = polygon[(end + k) % n]; v != leave && v != entry) behind.push_back(v);
    behind.push_back(entry);
    catalog::ConvexFace outside = part.faces[face];
    outside.vertices = std::move(beyond);
    part.faces[face].vertices = std::move(behind);
    part.faces.push_back(std::move(outside));
    built_.face_cut.push_back(built_.face_cut[face]);
    return true;
  }

  static double share_along(const std::vector<double>& height, std::size_t from, std::size_t to) {
    return height[from] / (height[from] - height[to]);
  }

  /// A new vertex on edge a -> b, put into the neighbouring face as well.
  int add_vertex(int a, int b, double share) {
    catalog::ConvexPart& part = built_.part;
    const int added = static_cast<int>(part.vertices.size());
    const Vec3 place = at(a) + share * (at(b) - at(a));
    const double size = norm(at(b) - at(a));
    Vec3 middle;
    for (const catalog::Point& p : part.vertices)
      middle += (1.0 / static_cast<double>(part.vertices.size())) * to_vec3(p);
    part.vertices.push_back(to_point(nudged_inside(place, built_.cell.planes, 1e-9 * size, middle)));
    for (catalog::ConvexFace& face : part.faces)
      for (std::size_t k = 0; k < face.vertices.size(); ++k)
        if (face.vertices[k] == b && face.vertices[(k + 1) % face.vertices.size()] == a) {
          face.vertices.insert(face.vertices.begin() + static_cast<std::ptrdiff_t>(k) + 1, added);
          break;
        }
    return added;
  }

  Vec3 at(int v) const { return to_vec3(built_.part.vertices[static_cast<std::size_t>(v)]); }

  BuiltPart& built_;
  const CutFrame& frame_;
  const SplitLimits& limits_;
};

/// Corners of all overlaps of the polygon with the others.
std::vector<Point2> overlap_corners(const Polygon2& polygon, const std::vector<Polygon2>& others) {
  std::vector<Point2> corners;
  for (const Polygon2& other : others)
    if (const Polygon2 common = intersection(polygon, other); area(common) > 0)
      corners.insert(corners.end(), common.begin(), common.end());
  return corners;
}

std::vector<Polygon2> outlines(const CutFrame& frame, const std::vector<BuiltPart>& parts,
                               const std::vector<CutFace>& faces) {
  std::vector<Polygon2> polygons;
  for (const CutFace& face : faces)
    polygons.push_back(outline(frame, parts[face.part].part, parts[face.part].part.faces[face.face]));
  return polygons;
}

}  // namespace

CutCoverage mark_faces(std::vector<BuiltPart>& parts, const std::vector<Plane>& cuts, const SplitLimits& limits) {
  CutCoverage coverage;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const CutFrame frame(cuts[c]);
    const CutSides whole = faces_on(parts, static_cast<int>(c), cuts[c]);
    const std::vector<Polygon2> polygons[2] = {outlines(frame, parts, whole.faces[0]),
                                               outlines(frame, parts, whole.faces[1])};
    for (int side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < whole.faces[side].size(); ++k) {
        const auto [p, f] = whole.faces[side][k];
        const std::vector<Point2> corners = overlap_corners(polygons[side][k], polygons[1 - side]);
        if (corners.empty()) continue;
        Polygon2 cover;
        for (const int corner : convex_hull(corners, 1e-6 * std::sqrt(area(polygons[side][k]))))
          cover.push_back(corners[static_cast<std::size_t>(corner)]);
        if (cover.size() >= 3) FaceSplitter(parts[p], frame, limits).split_beyond(f, cover);
      }
    const CutSides pieces = faces_on(parts, static_cast<int>(c), cuts[c]);
    for (int side = 0; side < 2; ++side)
      for (const auto& [p, f] : pieces.faces[side]) {
        catalog::ConvexFace& face = parts[p].part.faces[f];
        const Polygon2 polygon = outline(frame, parts[p].part, face);
        double covered = 0;
        for (const Polygon2& other : polygons[1 - side]) covered += area(intersection(polygon, other));
        const double bare = std::fmax(0.0, area(polygon) - covered);
        face.kind = covered > bare ? catalog::FaceKind::inner : catalog::FaceKind::outer;
        coverage.ledge_area += covered > bare ? bare : covered;
        if (side == 0) coverage.covered_area += covered;
      }
  }
  return coverage;
}

}  // namespace decomposition
