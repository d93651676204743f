// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "catalog/mass_properties.h"
#include "catalog/shape_record.h"

/// What the engine relies on, checked without the decomposition's own code.
namespace partition_checks {

__extension__ typedef __float128 Quad;

/// normal . x - offset: products of doubles are exact in quadruple precision.
inline Quad side(const catalog::FacePlane& plane, const catalog::Point& p) {
  Quad value = -static_cast<Quad>(plane.offset);
  for (int i = 0; i < 3; ++i) value += static_cast<Quad>(plane.normal[i]) * p[i];
  return value;
}

inline double size_of(const catalog::ConvexPart& part) {
  double size = 0;
  for (const catalog::Point& p : part.vertices)
    for (const catalog::Point& q : part.vertices)
      size = std::max(size, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
  return size;
}

inline double volume(const catalog::ConvexPart& part) {
  return catalog::volume_moments(catalog::triangulated(part)).volume;
}

inline double face_area(const catalog::ConvexPart& part, const catalog::ConvexFace& face) {
  catalog::Point twice{};
  const catalog::Point& o = part.vertices[face.vertices[0]];
  for (std::size_t k = 2; k < face.vertices.size(); ++k) {
    const catalog::Point &a = part.vertices[face.vertices[k - 1]], &b = part.vertices[face.vertices[k]];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, l = (i + 2) % 3;
      twice[i] += (a[j] - o[j]) * (b[l] - o[l]) - (a[l] - o[l]) * (b[j] - o[j]);
    }
  }
  return std::hypot(twice[0], twice[1], twice[2]) / 2;
}

inline void expect_sound_part(const catalog::ConvexPart& part, int vertex_cap) {
  ASSERT_GE(part.vertex_count(), 4u);
  EXPECT_LE(part.vertex_count(), static_cast<std::size_t>(vertex_cap));
  const double size = size_of(part);
  std::set<int> used;
  std::map<std::pair<int, int>, int> edges;
  for (const catalog::ConvexFace& face : part.faces) {
    ASSERT_GE(face.vertices.size(), 3u);
    const auto& n = face.plane.normal;
    EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-14);
    EXPECT_GT(face_area(part, face), 0);
    for (const catalog::Point& p : part.vertices) EXPECT_LE(static_cast<double>(side(face.plane, p)), 1e-9 * size);
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const int v = face.vertices[k], next = face.vertices[(k + 1) % face.vertices.size()];
      used.insert(v);
      EXPECT_NEAR(static_cast<double>(side(face.plane, part.vertices[v])), 0, 1e-9 * size);
      EXPECT_TRUE(edges.emplace(std::pair{v, next}, 1).second) << "an edge is used twice in one direction";
    }
  }
  for (const auto& [edge, count] : edges)
    EXPECT_TRUE(edges.contains({edge.second, edge.first})) << "the part is not closed";
  EXPECT_EQ(used.size(), part.vertex_count()) << "a vertex belongs to no face";
  EXPECT_EQ(part.vertex_count() + part.face_count(), edges.size() / 2 + 2) << "Euler";
  EXPECT_GT(volume(part), 0);
}

inline bool are_separated(const catalog::ConvexPart& a, const catalog::ConvexPart& b,
                          const std::vector<catalog::FacePlane>& planes) {
  const auto on_side = [](const catalog::ConvexPart& part, const catalog::FacePlane& plane, int sign) {
    for (const catalog::Point& p : part.vertices)
      if (sign * side(plane, p) < 0) return false;
    return true;
  };
  for (const catalog::FacePlane& plane : planes)
    if ((on_side(a, plane, -1) && on_side(b, plane, 1)) || (on_side(a, plane, 1) && on_side(b, plane, -1))) return true;
  return false;
}

using QuadVector = std::array<Quad, 3>;

/// Whether the parts lie apart along the axis, without tolerance.
inline bool are_apart_along(const QuadVector& axis, const catalog::ConvexPart& a, const catalog::ConvexPart& b) {
  const auto along = [&](const catalog::Point& p) { return axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2]; };
  Quad low[2], high[2];
  for (int k = 0; k < 2; ++k) {
    const catalog::ConvexPart& part = k == 0 ? a : b;
    low[k] = high[k] = along(part.vertices[0]);
    for (const catalog::Point& p : part.vertices) {
      low[k] = std::min(low[k], along(p));
      high[k] = std::max(high[k], along(p));
    }
  }
  return high[0] <= low[1] || high[1] <= low[0];
}

inline QuadVector edge_between(const catalog::ConvexPart& part, int from, int to) {
  QuadVector edge;
  for (int i = 0; i < 3; ++i) edge[i] = static_cast<Quad>(part.vertices[to][i]) - part.vertices[from][i];
  return edge;
}

/// The separating axis test for parts with a gap between them: cross products of edges, a third of them the normals of
/// faces.
inline bool have_gap(const catalog::ConvexPart& a, const catalog::ConvexPart& b) {
  std::vector<QuadVector> edges;
  for (const catalog::ConvexPart* part : {&a, &b})
    for (const catalog::ConvexFace& face : part->faces)
      for (std::size_t k = 0; k < face.vertices.size(); ++k)
        if (const int v = face.vertices[k], w = face.vertices[(k + 1) % face.vertices.size()]; v < w)
          edges.push_back(edge_between(*part, v, w));
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (std::size_t f = e + 1; f < edges.size(); ++f) {
      const QuadVector &u = edges[e], &v = edges[f];
      const QuadVector axis{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      if ((axis[0] != 0 || axis[1] != 0 || axis[2] != 0) && are_apart_along(axis, a, b)) return true;
    }
  return false;
}

/// Sound parts, every pair separated by a face plane or a gap, without any tolerance, so that no two parts overlap.
inline void expect_partition(const catalog::LevelOfDetail& level) {
  EXPECT_LE(level.parts.size(), static_cast<std::size_t>(level.key.parts_asked));
  ASSERT_FALSE(level.parts.empty());
  std::vector<catalog::FacePlane> planes;
  for (const catalog::ConvexPart& part : level.parts) {
    expect_sound_part(part, level.key.vertex_cap);
    for (const catalog::ConvexFace& face : part.faces) planes.push_back(face.plane);
  }
  for (std::size_t a = 0; a < level.parts.size(); ++a)
    for (std::size_t b = a + 1; b < level.parts.size(); ++b)
      EXPECT_TRUE(are_separated(level.parts[a], level.parts[b], planes) || have_gap(level.parts[a], level.parts[b]))
          << "parts " << a << " and " << b;
}

/// Area of inner faces on each oriented plane, keyed by the plane's bits.
using PlaneKey = std::array<double, 4>;
inline std::map<PlaneKey, double> inner_areas(const catalog::LevelOfDetail& level) {
  std::map<PlaneKey, double> areas;
  for (const catalog::ConvexPart& part : level.parts)
    for (const catalog::ConvexFace& face : part.faces)
      if (face.kind == catalog::FaceKind::inner) {
        const auto& n = face.plane.normal;
        areas[{n[0] + 0.0, n[1] + 0.0, n[2] + 0.0, face.plane.offset + 0.0}] += face_area(part, face);
      }
  return areas;
}

/// Every plane with inner faces is there with its sign reversed, bit for bit, and carries about the same inner area.
inline void expect_matching_cuts(const catalog::LevelOfDetail& level, double tolerance) {
  const std::map<PlaneKey, double> areas = inner_areas(level);
  for (const auto& [plane, area] : areas) {
    const PlaneKey other{-plane[0] + 0.0, -plane[1] + 0.0, -plane[2] + 0.0, -plane[3] + 0.0};
    ASSERT_TRUE(areas.contains(other)) << "no inner face on the other side of a cut";
    EXPECT_NEAR(area / areas.at(other), 1, tolerance);
  }
}

/// What decompose() reports as LevelFigures::ledge_area.
inline double ledge_share(const catalog::LevelOfDetail& level) {
  const std::string key = "\"ledge_area_ratio\":", &text = level.provenance.options;
  return std::stod(text.substr(text.find(key) + key.size()));
}

/// The inner areas of the two sides of every cut differ by the ledges that the level reports, and by no more.
inline void expect_cuts_matching_but_for_ledges(const catalog::LevelOfDetail& level) {
  const std::map<PlaneKey, double> areas = inner_areas(level);
  double all = 0, difference = 0;
  for (const auto& [plane, area] : areas) {
    const auto other = areas.find({-plane[0] + 0.0, -plane[1] + 0.0, -plane[2] + 0.0, -plane[3] + 0.0});
    all += area;
    // Each pair of sides is met twice, a side without inner faces once.
    difference += other == areas.end() ? area : std::abs(area - other->second) / 2;
  }
  // Both sides together hold twice the covered area, but for ledges.
  const double share = ledge_share(level);
  EXPECT_LE(difference, share * all / (2 - share) + 1e-9 * all);
  EXPECT_LT(share, 0.5);
}

/// No edge of a part is shorter, and no face narrower, than that share of the part's size (of size_of).
inline void expect_no_slivers(const catalog::LevelOfDetail& level, double shortest_edge, double narrowest_face) {
  for (const catalog::ConvexPart& part : level.parts) {
    const double size = size_of(part);
    for (const catalog::ConvexFace& face : part.faces) {
      double width = size;
      for (std::size_t k = 0; k < face.vertices.size(); ++k) {
        const catalog::Point& a = part.vertices[face.vertices[k]];
        const catalog::Point& b = part.vertices[face.vertices[(k + 1) % face.vertices.size()]];
        const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        EXPECT_GE(length, shortest_edge * size);
        double reach = 0;  // of the face from the line through this edge
        for (const int v : face.vertices) {
          const catalog::Point& p = part.vertices[v];
          catalog::Point twice{};
          for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, l = (i + 2) % 3;
            twice[i] = (b[j] - a[j]) * (p[l] - a[l]) - (b[l] - a[l]) * (p[j] - a[j]);
          }
          reach = std::max(reach, std::hypot(twice[0], twice[1], twice[2]) / length);
        }
        width = std::min(width, reach);
      }
      EXPECT_GE(width, narrowest_face * size);
    }
  }
}

/// Whether a point lies in a part, on its faces included, without any tolerance.
inline bool holds(const catalog::ConvexPart& part, const catalog::Point& p) {
  for (const catalog::ConvexFace& face : part.faces)
    if (side(face.plane, p) > 0) return false;
  return true;
}

inline bool holds(const catalog::LevelOfDetail& level, const catalog::Point& p) {
  for (const catalog::ConvexPart& part : level.parts)
    if (holds(part, p)) return true;
  return false;
}

/// The same parts, figures and provenance to the last bit.
inline void expect_same_bytes(const catalog::LevelOfDetail& a, const catalog::LevelOfDetail& b) {
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t p = 0; p < a.parts.size(); ++p) {
    EXPECT_EQ(a.parts[p].vertices, b.parts[p].vertices);
    ASSERT_EQ(a.parts[p].face_count(), b.parts[p].face_count());
    for (std::size_t f = 0; f < a.parts[p].face_count(); ++f) {
      const catalog::ConvexFace &one = a.parts[p].faces[f], &other = b.parts[p].faces[f];
      EXPECT_EQ(one.vertices, other.vertices);
      EXPECT_EQ(one.plane.normal, other.plane.normal);
      EXPECT_EQ(one.plane.offset, other.plane.offset);
      EXPECT_EQ(one.kind, other.kind);
    }
  }
  EXPECT_EQ(a.error.symmetric_difference, b.error.symmetric_difference);
  EXPECT_EQ(a.provenance.options, b.provenance.options);
}

/// Smallest extent of a part along one of its face normals [m].
inline double thickness(const catalog::ConvexPart& part) {
  double least = size_of(part);
  for (const catalog::ConvexFace& face : part.faces) {
    double deepest = 0;
    for (const catalog::Point& p : part.vertices)
      deepest = std::max(deepest, -static_cast<double>(side(face.plane, p)));
    least = std::min(least, deepest);
  }
  return least;
}

inline double total_volume(const catalog::LevelOfDetail& level) {
  double sum = 0;
  for (const catalog::ConvexPart& part : level.parts) sum += volume(part);
  return sum;
}

}  // namespace partition_checks
