// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "decomposition/fit/sections.h"
#include "decomposition/geometry/small_hull.h"

namespace decomposition {

/// Share of the diagonal of the whole: nearer corners of sections are one.
inline constexpr double kSameCorner = 1e-9;

/// The polyhedron of a leaf.
struct LeafShape {
  std::vector<Plane> cell;
  std::vector<Vec3> points;           // own points, then corners on the cuts
  std::vector<int> nodes;             // section node of each corner on the cuts
  std::vector<std::uint64_t> on_cut;  // (n_points) bit s % 64: lies on side s of the cell
  std::vector<Vec3> bent;  // points with the faces on the cuts bent outward by a millionth: in general position
  SmallHull hull;          // of the bent points
  Vec3 centre;             // mean of the points

  /// False if it is flat. `diagonal`: of the whole.
  bool update(const Partition& partition, const Leaf& leaf, SectionPolygons& polygons, double diagonal);

  std::size_t own_count() const { return points.size() - nodes.size(); }
  bool is_on_one_cut(const std::array<int, 3>& triangle) const { return common_cuts(triangle) != 0; }
  /// Faces as polygons: triangles, and one polygon on every cut that has any.
  std::vector<std::vector<int>> faces() const;
  double size() const;  // largest distance of two points

 private:
  std::uint64_t common_cuts(const std::array<int, 3>& triangle) const {
    return on_cut[static_cast<std::size_t>(triangle[0])] & on_cut[static_cast<std::size_t>(triangle[1])] &
           on_cut[static_cast<std::size_t>(triangle[2])];
  }
};

}  // namespace decomposition
