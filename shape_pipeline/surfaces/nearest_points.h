// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// The k points nearest to each query, nearest first: n_queries x k indices into points (fewer if there are fewer
/// points). A query that is itself one of the points finds itself first.
std::vector<std::vector<int>> nearest_points(const std::vector<catalog::Point>& points,
                                             const std::vector<catalog::Point>& queries, int k);

/// The same for one neighbour and many calls: the tree is built once.
class NearestPoint {
 public:
  explicit NearestPoint(const std::vector<catalog::Point>& points);  // at least one
  ~NearestPoint();
  NearestPoint(NearestPoint&&) noexcept;

  /// Index of the nearest point.
  int operator()(const catalog::Point& query) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace shape_pipeline
