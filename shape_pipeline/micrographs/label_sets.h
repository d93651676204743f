// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace shape_pipeline {

/// Labels 0 to count - 1 in sets that are joined (union-find with path halving).
class LabelSets {
 public:
  explicit LabelSets(int count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int add() {
    parent_.push_back(static_cast<int>(parent_.size()));
    return parent_.back();
  }
  int root(int label) {
    while (parent(label) != label) label = parent(label) = parent(parent(label));
    return label;
  }
  /// The set of `label` becomes part of that of `into`.
  void join(int label, int into) { parent(root(label)) = root(into); }

 private:
  int& parent(int label) { return parent_[static_cast<std::size_t>(label)]; }

  std::vector<int> parent_;
};

}  // namespace shape_pipeline
