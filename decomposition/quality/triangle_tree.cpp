// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/quality/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace decomposition {
namespace {

constexpr int kLeafSize = 4;

double component(const Vec3& p, int axis) { return axis == 0 ? p.x : (axis == 1 ? p.y : p.z); }

double squared_distance(const Vec3& p, const Box& box) {
  const auto beyond = [](double x, double low, double high) { return std::fmax(std::fmax(low - x, x - high), 0.0); };
  const Vec3 d{beyond(p.x, box.low.x, box.high.x), beyond(p.y, box.low.y, box.high.y),
               beyond(p.z, box.low.z, box.high.z)};
  return dot(d, d);
}

double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a, ap = p - a;
  const double length = dot(ab, ab);
  const double t = length > 0 ? std::clamp(dot(ap, ab) / length, 0.0, 1.0) : 0.0;
  const Vec3 d = ap - t * ab;
  return dot(d, d);
}

/// Over the triangle's inside the distance to its plane counts, elsewhere that to the nearest edge.
double squared_distance(const Vec3& p, const std::array<Vec3, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3 normal = cross(b - a, c - a);
  const double length = dot(normal, normal);
  const auto is_inside = [&](const Vec3& from, const Vec3& to) { return dot(cross(to - from, p - from), normal) >= 0; };
  if (length > 0 && is_inside(a, b) && is_inside(b, c) && is_inside(c, a)) {
    const double height = dot(p - a, normal);
    return height * height / length;
  }
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

}  // namespace

TriangleTree::TriangleTree(std::vector<std::array<Vec3, 3>> triangles) : triangles_(std::move(triangles)) {
  if (triangles_.empty()) return;
  nodes_.reserve(triangles_.size());
  nodes_.emplace_back();
  split(0, 0, static_cast<int>(triangles_.size()));
}

void TriangleTree::split(std::size_t node, int first, int count) {
  const auto begin = triangles_.begin() + first;
  Box box{begin->front(), begin->front()};
  for (auto t = begin; t != begin + count; ++t)
    for (const Vec3& corner : *t) box.extend(corner);
  nodes_[node].box = box;
  if (count <= kLeafSize) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const Vec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const auto key = [&](const std::array<Vec3, 3>& t) {
    return component(t[0], axis) + component(t[1], axis) + component(t[2], axis);
  };
  const int half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](const auto& a, const auto& b) { return key(a) < key(b); });
  const auto child = static_cast<int>(nodes_.size());
  nodes_[node].first = child;
  nodes_.emplace_back();
  nodes_.emplace_back();
  split(static_cast<std::size_t>(child), first, half);
  split(static_cast<std::size_t>(child) + 1, first + half, count - half);
}

double TriangleTree::distance(const Vec3& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  if (nodes_.empty()) return nearest;
  std::vector<std::pair<double, int>> open{{squared_distance(p, nodes_[0].box), 0}};
  while (!open.empty()) {
    const auto [bound, index] = open.back();
    open.pop_back();
    if (bound >= nearest) continue;
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    for (int t = 0; t < node.count; ++t)
      nearest = std::fmin(nearest, squared_distance(p, triangles_[static_cast<std::size_t>(node.first + t)]));
    if (node.count > 0) continue;
    std::pair<double, int> children[2];
    for (int k = 0; k < 2; ++k)
      children[k] = {squared_distance(p, nodes_[static_cast<std::size_t>(node.first + k)].box), node.first + k};
    if (children[0].first < children[1].first) std::swap(children[0], children[1]);
    open.push_back(children[0]);
    open.push_back(children[1]);  // the nearer one is looked at first
  }
  return std::sqrt(nearest);
}

}  // namespace decomposition
