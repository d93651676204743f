// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/sections.h"

#include <algorithm>

#include "decomposition/geometry/convex_polygon.h"

namespace decomposition {

std::vector<int> SectionPolygons::clipped(std::vector<int> polygon, const CutSide& side) {
  const Plane plane = partition_->plane_of(side);
  std::vector<double> height;
  for (const int node : polygon) {
    const double h = plane.signed_distance(at(node));
    height.push_back(std::abs(h) <= tolerance_ ? 0 : h);
  }
  if (std::none_of(height.begin(), height.end(), [](double h) { return h > 0; })) return polygon;
  std::vector<int> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = (k + 1) % polygon.size();
    const double h = height[k], g = height[next];
    if (h <= 0) kept.push_back(polygon[k]);
    if ((h < 0 && g > 0) || (h > 0 && g < 0)) {
      SectionNode node;
      node.cut = side.cut;
      node.from = polygon[k];
      node.to = polygon[next];
      node.share = h / (h - g);
      node.place = at(node.from) + node.share * (at(node.to) - at(node.from));
      kept.push_back(static_cast<int>(nodes_.size()));
      nodes_.push_back(node);
    }
  }
  return kept;
}

std::vector<int> SectionPolygons::convex_polygon(const std::vector<int>& points, const Plane& plane) const {
  Vec3 u, v;
  plane_axes(plane.normal, u, v);
  std::vector<Point2> flat;
  for (const int node : points) flat.push_back({dot(u, at(node)), dot(v, at(node))});
  std::vector<int> polygon;
  for (const int corner : convex_hull(flat, tolerance_)) polygon.push_back(points[static_cast<std::size_t>(corner)]);
  if (polygon.size() < 3) polygon.clear();
  return polygon;
}

void SectionPolygons::build(const Partition& partition, double tolerance) {
  partition_ = &partition;
  tolerance_ = tolerance;
  nodes_.clear();
  polygons_.assign(partition.sections.size(), {});
  for (std::size_t s = 0; s < partition.sections.size(); ++s) {
    const Section& section = partition.sections[s];
    const Cut& cut = partition.cut_of(section);
    std::vector<int> points;
    for (const int wall : section.walls) {
      // Where the wall, as far as it bounds this cell, ends on this plane.
      std::vector<int> bound = polygon(wall);
      for (const CutSide& other : cut.sides)
        if (other.cut != partition.sections[static_cast<std::size_t>(wall)].cut && !bound.empty())
          bound = clipped(std::move(bound), other);
      if (bound.size() < 3) continue;
      for (const int node : clipped(std::move(bound), {section.cut, false}))
        if (std::abs(cut.plane.signed_distance(at(node))) <= tolerance) points.push_back(node);
    }
    for (std::size_t k = 0; k < section.corners.size(); ++k) {
      SectionNode node;
      node.place = section.corners[k];
      node.cut = section.cut;
      node.section = static_cast<int>(s);
      node.corner = static_cast<int>(k);
      points.push_back(static_cast<int>(nodes_.size()));
      nodes_.push_back(node);
    }
    if (points.size() >= 3) polygons_[s] = convex_polygon(points, cut.plane);
  }
}

std::vector<int> SectionPolygons::corners_of(const Leaf& leaf) {
  std::vector<int> corners;
  for (const int section : leaf.sections) {
    std::vector<int> face = polygon(section);
    for (const CutSide& side : leaf.sides)
      if (side.cut != partition_->sections[static_cast<std::size_t>(section)].cut && !face.empty())
        face = clipped(std::move(face), side);
    for (const int node : face)
      if (std::none_of(corners.begin(), corners.end(),
                       [&](int known) { return norm(at(known) - at(node)) <= 1e4 * tolerance_; }))
        corners.push_back(node);
  }
  return corners;
}

}  // namespace decomposition
