// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/nearest_points.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/property_map.h>

#include <utility>

namespace shape_pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using IndexedPoint = std::pair<Kernel::Point_3, int>;
using Traits = CGAL::Search_traits_adapter<IndexedPoint, CGAL::First_of_pair_property_map<IndexedPoint>,
                                           CGAL::Search_traits_3<Kernel>>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;

std::vector<IndexedPoint> numbered(const std::vector<catalog::Point>& points) {
  std::vector<IndexedPoint> indexed;
  indexed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    indexed.emplace_back(Kernel::Point_3(points[i][0], points[i][1], points[i][2]), static_cast<int>(i));
  return indexed;
}

}  // namespace

struct NearestPoint::Tree {
  Search::Tree search;
};

NearestPoint::NearestPoint(const std::vector<catalog::Point>& points) : tree_(std::make_unique<Tree>()) {
  const std::vector<IndexedPoint> indexed = numbered(points);
  tree_->search.insert(indexed.begin(), indexed.end());
  tree_->search.build();
}

NearestPoint::~NearestPoint() = default;
NearestPoint::NearestPoint(NearestPoint&&) noexcept = default;

int NearestPoint::operator()(const catalog::Point& query) const {
  const Search search(tree_->search, Kernel::Point_3(query[0], query[1], query[2]), 1);
  return search.begin()->first.second;
}

std::vector<std::vector<int>> nearest_points(const std::vector<catalog::Point>& points,
                                             const std::vector<catalog::Point>& queries, int k) {
  const std::vector<IndexedPoint> indexed = numbered(points);
  const Search::Tree tree(indexed.begin(), indexed.end());
  std::vector<std::vector<int>> result(queries.size());
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const Search search(tree, Kernel::Point_3(queries[q][0], queries[q][1], queries[q][2]),
                        static_cast<unsigned int>(k));
    for (const auto& [neighbour, squared_distance] : search) result[q].push_back(neighbour.second);
  }
  return result;
}

}  // namespace shape_pipeline
