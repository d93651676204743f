// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "decomposition/geometry/vector3.h"

namespace decomposition {

/// Bounding-box tree over triangles for nearest-distance queries.
class TriangleTree {
 public:
  explicit TriangleTree(std::vector<std::array<Vec3, 3>> triangles);

  /// Distance from p to the nearest triangle; infinite for an empty tree.
  double distance(const Vec3& p) const;

 private:
  struct Node {
    Box box;
    int first = 0, count = 0;  // triangles of a leaf; count 0: inner node, children at `first` and `first` + 1
  };
  void split(std::size_t node, int first, int count);

  std::vector<std::array<Vec3, 3>> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace decomposition
