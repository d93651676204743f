// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "decomposition/fit/partition.h"

namespace decomposition {

/// A corner of a section: one of its own, or the point where the edge between two other nodes meets a cut.
struct SectionNode {
  Vec3 place;
  int cut = -1;                   // that it lies on; of a derived node the one that its edge meets
  int section = -1, corner = -1;  // of an own corner: Section::corners[corner]
  int from = -1, to = -1;         // of a derived node: place = (1 - share) from + share to
  double share = 0;
  bool is_free() const { return from < 0; }
};

/// The polygons on the cuts of a partition, derived from the own corners in the order of the cuts.
class SectionPolygons {
 public:
  /// `tolerance` [m]: nearer points are one.
  void build(const Partition& partition, double tolerance);

  /// Corners of a leaf on its cuts, as nodes; no two at one place.
  std::vector<int> corners_of(const Leaf& leaf);

  const std::vector<SectionNode>& nodes() const { return nodes_; }
  /// Nodes around a section, counter-clockwise about its plane's normal; empty if nothing is there.
  const std::vector<int>& polygon(int section) const { return polygons_[static_cast<std::size_t>(section)]; }

 private:
  std::vector<int> clipped(std::vector<int> polygon, const CutSide& side);
  std::vector<int> convex_polygon(const std::vector<int>& points, const Plane& plane) const;
  const Vec3& at(int node) const { return nodes_[static_cast<std::size_t>(node)].place; }

  const Partition* partition_ = nullptr;
  double tolerance_ = 0;
  std::vector<SectionNode> nodes_;
  std::vector<std::vector<int>> polygons_;
};

}  // namespace decomposition
