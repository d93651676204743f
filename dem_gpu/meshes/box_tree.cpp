// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/meshes/box_tree.h"

#include <numeric>

namespace dem_gpu {
namespace {

constexpr int kLeafItems = 4;

struct Builder {
  const std::vector<Box>& boxes;
  BoxTree& tree;

  Vec3 middle(int box) const {
    const Box& b = boxes[static_cast<std::size_t>(box)];
    return b.low + b.high;
  }

  void build(int first, int last) {
    const std::size_t self = tree.nodes.size();
    tree.nodes.emplace_back();
    Box box, middles;
    for (int i = first; i < last; ++i) {
      const int item = tree.order[static_cast<std::size_t>(i)];
      box.include(boxes[static_cast<std::size_t>(item)].low);
      box.include(boxes[static_cast<std::size_t>(item)].high);
      middles.include(middle(item));
    }
    tree.nodes[self].box = box;
    if (last - first <= kLeafItems) {
      tree.nodes[self].first = first;
      tree.nodes[self].count = last - first;
    } else {
      const int half = split(first, last, middles.high - middles.low);
      build(first, half);
      build(half, last);
    }
    tree.nodes[self].skip = static_cast<int>(tree.nodes.size());
  }

  /// Half of the items on each side, by their middles along the widest axis; ties by index, so the tree is one.
  int split(int first, int last, const Vec3& extent) {
    const Vec3 axis = extent.x >= extent.y && extent.x >= extent.z ? Vec3{1, 0, 0}
                      : extent.y >= extent.z                       ? Vec3{0, 1, 0}
                                                                   : Vec3{0, 0, 1};
    const int half = first + (last - first) / 2;
    std::nth_element(tree.order.begin() + first, tree.order.begin() + half, tree.order.begin() + last,
                     [&](int a, int b) {
                       const Real at_a = dot(middle(a), axis), at_b = dot(middle(b), axis);
                       return at_a != at_b ? at_a < at_b : a < b;
                     });
    return half;
  }
};

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) : order(boxes.size()) {
  std::iota(order.begin(), order.end(), 0);
  if (!boxes.empty()) Builder{boxes, *this}.build(0, static_cast<int>(boxes.size()));
}

}  // namespace dem_gpu
