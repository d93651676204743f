// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Box along the axes.
struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};  // [m]

  TALUS_HD void include(const Vec3& x) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  TALUS_HD bool overlaps(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
           low.z <= other.high.z && other.low.z <= high.z;
  }
  TALUS_HD bool is_within(const Vec3& x, Real reach) const {
    const auto beyond = [](Real value, Real least, Real most) {
      return value < least ? least - value : value > most ? value - most : Real(0);
    };
    const Vec3 gap{beyond(x.x, low.x, high.x), beyond(x.y, low.y, high.y), beyond(x.z, low.z, high.z)};
    return norm_squared(gap) <= reach * reach;
  }
};

/// Node of a tree of boxes, stored depth first: the walk goes on at the next node, or at `skip` where the box misses.
struct BoxNode {
  Box box;
  int first = 0, count = 0;  // items of a leaf; count 0 for an inner node
  int skip = 0;              // node after this one's subtree
};

/// hit(box) says whether a subtree can hold what is looked for; visitor(item) is called for each item of the leaves
/// left, in ascending order; a visitor that returns false ends the walk.
template <class Hit, class Visitor>
TALUS_HD void walk_boxes(const BoxNode* nodes, int node_count, const Hit& hit, Visitor&& visitor) {
  for (int n = 0; n < node_count;) {
    const BoxNode& node = nodes[n];
    if (!hit(node.box)) {
      n = node.skip;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i)
      if (!visitor(i)) return;
    ++n;
  }
}

/// Tree over boxes: items are renumbered so that each leaf is a run, and a walk meets them in ascending order.
struct BoxTree {
  std::vector<BoxNode> nodes;
  std::vector<int> order;  // box of each item, n_boxes

  explicit BoxTree(const std::vector<Box>& boxes);

  /// visitor(box index) for each box that overlaps `box`; false ends the walk.
  template <class Visitor>
  void visit_overlapping(const Box& box, Visitor&& visitor) const {
    walk_boxes(
        nodes.data(), static_cast<int>(nodes.size()), [&](const Box& other) { return box.overlaps(other); },
        [&](int item) { return visitor(order[static_cast<std::size_t>(item)]); });
  }
};

}  // namespace dem_gpu
