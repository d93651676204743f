// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/part_rules.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

#include "decomposition/fit/joint_fit.h"
#include "decomposition/fit/leaf_shape.h"
#include "decomposition/fit/part_fit.h"

namespace decomposition {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kCornerPenalty = 2;   // on the loss of a section's corner: it does not come back
constexpr double kDroppedPenalty = 2;  // on the loss of another's corner: it leaves a ledge
constexpr double kGapPenalty = 6;      // the same of a corner inside the solid: it leaves a gap there
constexpr double kInside = 0.95;       // occupancy
constexpr int kVolumeRounds = 12;
constexpr double kLargestOffset = 0.1;  // of the volume correction / diagonal
constexpr double kVolumeTolerance = 1e-6;

/// Vertices of which one must go, and how badly: below 1 is a breach.
struct Flaw {
  double severity = 1;
  std::vector<int> vertices;
};

double distance_to_line(const Vec3& p, const Vec3& a, const Vec3& b) { return norm(cross(b - a, p - a)) / norm(b - a); }

/// Breaches of the rules, worst first; of the caps before all.
std::vector<Flaw> find_flaws(const LeafShape& shape, const PartRules& rules, bool with_slivers) {
  const std::vector<std::vector<int>> faces = shape.faces();
  std::vector<Flaw> flaws;
  if (shape.hull.vertex_count() > rules.vertices || (rules.faces > 0 && static_cast<int>(faces.size()) > rules.faces)) {
    flaws.push_back({0, {}});
    for (std::size_t v = 0; v < shape.points.size(); ++v)
      if (shape.hull.is_vertex(static_cast<int>(v))) flaws.back().vertices.push_back(static_cast<int>(v));
  }
  if (!with_slivers) return flaws;
  const double size = shape.size();
  const auto at = [&](int v) { return shape.points[static_cast<std::size_t>(v)]; };
  for (const std::vector<int>& face : faces) {
    double width = kInfinity, shortest = kInfinity;
    std::vector<int> ends;  // of the shortest edge
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int a = face[k], b = face[(k + 1) % face.size()];
      const double length = norm(at(b) - at(a));
      if (length < shortest) shortest = length, ends = {a, b};
      if (a < b && length < rules.shortest_edge * size)
        flaws.push_back({length / (rules.shortest_edge * size), {a, b}});
      double reach = 0;
      for (const int v : face) reach = std::fmax(reach, distance_to_line(at(v), at(a), at(b)));
      width = std::fmin(width, reach);
    }
    // A triangle with a short edge is narrow wherever its third corner is.
    const double least = rules.narrowest_face * size;
    if (width < least) flaws.push_back({width / least, face.size() == 3 && shortest < least ? ends : face});
  }
  std::stable_sort(flaws.begin(), flaws.end(), [](const Flaw& a, const Flaw& b) { return a.severity < b.severity; });
  return flaws;
}

class LeafTrimmer {
 public:
  LeafTrimmer(const Solid& solid, Partition& partition, std::size_t leaf, const PartRules& rules, Trim what, int most)
      : solid_(solid), partition_(partition), leaf_(partition.leaves[leaf]), rules_(rules), what_(what), most_(most) {}

  /// False if the leaf collapsed.
  bool run() {
    while (true) {
      if (!update()) return false;
      const std::vector<Flaw> flaws = find_flaws(shape_, rules_, what_ != Trim::caps && most_ > 0);
      const bool is_helped = std::any_of(flaws.begin(), flaws.end(), [&](const Flaw& flaw) { return mend(flaw); });
      if (!is_helped) return true;
      if (flaws.front().severity > 0) --most_;
    }
  }

 private:
  bool update() {
    polygons_.build(partition_, kSameCorner * solid_.diagonal());
    return shape_.update(partition_, leaf_, polygons_, solid_.diagonal());
  }

  const SectionNode* node_of(int vertex) const {
    const std::size_t own = shape_.own_count(), v = static_cast<std::size_t>(vertex);
    return v < own ? nullptr : &polygons_.nodes()[static_cast<std::size_t>(shape_.nodes[v - own])];
  }

  /// Volume lost without the vertex, weighted; infinite if it must stay.
  double loss(int vertex) {
    const SectionNode* node = node_of(vertex);
    if (node && what_ == Trim::own_points) return kInfinity;
    if (node && what_ != Trim::all) return node->is_free() ? loss_of_corner(*node) : kInfinity;
    std::vector<Vec3> rest = shape_.bent;
    rest.erase(rest.begin() + vertex);
    if (!hull_.build(rest)) return kInfinity;
    const double penalty = !node ? 1 : (solid_.occupancy(node->place) > kInside ? kGapPenalty : kDroppedPenalty);
    return penalty * std::fmax(0.0, shape_.hull.volume() - hull_.volume());
  }

  /// What all parts at a section lose without one of its corners.
  double loss_of_corner(const SectionNode& node) {
    if (polygons_.polygon(node.section).size() <= 3) return kInfinity;
    std::vector<Vec3>& corners = partition_.sections[static_cast<std::size_t>(node.section)].corners;
    const std::vector<Vec3> whole = corners;
    const double before = volume_at(node.section);
    corners.erase(corners.begin() + node.corner);
    const double after = volume_at(node.section);
    corners = whole;
    return kCornerPenalty * std::fmax(0.0, before - after);
  }

  /// Volume of the parts at a section; that of none if one of them is flat.
  double volume_at(int section) const {
    SectionPolygons polygons;
    polygons.build(partition_, kSameCorner * solid_.diagonal());
    double volume = 0;
    for (const Leaf& leaf : partition_.leaves) {
      if (std::find(leaf.sections.begin(), leaf.sections.end(), section) == leaf.sections.end()) continue;
      LeafShape shape;
      if (!shape.update(partition_, leaf, polygons, solid_.diagonal())) return -kInfinity;
      volume += shape.hull.volume();
    }
    return volume;
  }

  bool mend(const Flaw& flaw) {
    double least = kInfinity;
    int chosen = -1;
    for (const int v : flaw.vertices)
      if (const double cost = loss(v); cost < least) least = cost, chosen = v;
    // Dear where only a vertex far from the flaw can go: another means must do.
    const bool is_forced = what_ == Trim::all || flaw.severity == 0;
    if (chosen < 0 || (!is_forced && least > rules_.largest_loss * shape_.hull.volume())) return false;
    const SectionNode* node = node_of(chosen);
    if (!node)
      leaf_.points.erase(leaf_.points.begin() + chosen);
    else if (what_ == Trim::all)
      leaf_.dropped.push_back(node->place);
    else {
      std::vector<Vec3>& corners = partition_.sections[static_cast<std::size_t>(node->section)].corners;
      corners.erase(corners.begin() + node->corner);
    }
    return true;
  }

  const Solid& solid_;
  Partition& partition_;
  Leaf& leaf_;
  const PartRules& rules_;
  Trim what_;
  int most_;
  SectionPolygons polygons_;
  LeafShape shape_;
  SmallHull hull_;
};

/// The parts' polyhedra; empty if one is flat.
std::vector<LeafShape> shapes_of(const Solid& solid, const Partition& partition) {
  SectionPolygons polygons;
  polygons.build(partition, kSameCorner * solid.diagonal());
  std::vector<LeafShape> shapes(partition.leaves.size());
  for (std::size_t a = 0; a < shapes.size(); ++a)
    if (!shapes[a].update(partition, partition.leaves[a], polygons, solid.diagonal())) return {};
  return shapes;
}

double total_volume(const std::vector<LeafShape>& shapes) {
  return std::accumulate(shapes.begin(), shapes.end(), 0.0,
                         [](double sum, const LeafShape& shape) { return sum + shape.hull.volume(); });
}

}  // namespace

std::vector<int> trim(const Solid& solid, Partition& partition, const PartRules& rules, Trim what, int most) {
  std::vector<int> lost;
  for (std::size_t a = 0; a < partition.leaves.size(); ++a) {
    const std::size_t before = partition.leaves[a].points.size();
    if (!LeafTrimmer(solid, partition, a, rules, what, most).run()) return {};
    lost.push_back(static_cast<int>(before - partition.leaves[a].points.size()));
  }
  return lost;
}

int count_flaws(const Solid& solid, const Partition& partition, const PartRules& rules) {
  std::size_t count = 0;
  for (const LeafShape& shape : shapes_of(solid, partition)) count += find_flaws(shape, rules, true).size();
  return static_cast<int>(count);
}

void drop_dead_points(const Solid& solid, Partition& partition) {
  const std::vector<LeafShape> shapes = shapes_of(solid, partition);
  for (std::size_t a = 0; a < shapes.size(); ++a) {
    std::vector<Vec3> alive;
    for (std::size_t v = 0; v < shapes[a].own_count(); ++v)
      if (shapes[a].hull.is_vertex(static_cast<int>(v))) alive.push_back(shapes[a].points[v]);
    partition.leaves[a].points = std::move(alive);
  }
}

void scale_volume(Partition& partition, const Vec3& centre, double ratio) {
  const double factor = std::cbrt(ratio);
  const auto scale = [&](std::vector<Vec3>& points) {
    for (Vec3& p : points) p = centre + factor * (p - centre);
  };
  for (Cut& cut : partition.cuts)
    cut.plane.offset = factor * cut.plane.offset + (1 - factor) * dot(cut.plane.normal, centre);
  for (Section& section : partition.sections) scale(section.corners);
  for (Leaf& leaf : partition.leaves) {
    scale(leaf.points);
    scale(leaf.dropped);
  }
}

void correct_volume(const Solid& solid, Partition& partition, double volume) {
  std::vector<LeafShape> shapes = shapes_of(solid, partition);
  if (shapes.empty()) return;
  const Partition start = partition;
  std::vector<std::vector<Vec3>> outward(shapes.size());
  double rate = 0;  // of the volume with the offset
  for (std::size_t a = 0; a < shapes.size(); ++a) {
    std::vector<Vec3> area(shapes[a].points.size());
    for (const auto& triangle : shapes[a].hull.faces()) {
      const auto at = [&](std::size_t k) { return shapes[a].points[static_cast<std::size_t>(triangle[k])]; };
      for (const int v : triangle) area[static_cast<std::size_t>(v)] += (1 / 6.0) * cross(at(1) - at(0), at(2) - at(0));
    }
    area.resize(shapes[a].own_count());
    for (Vec3& vector : area) {
      const double length = norm(vector);
      if (length > 0) vector = (1 / length) * vector;
      rate += length;
    }
    outward[a] = std::move(area);
  }
  double offset = 0;
  for (int round = 0; round < kVolumeRounds && rate > 0; ++round) {
    const double lack = volume - total_volume(shapes);
    if (std::abs(lack) < kVolumeTolerance * volume) return;
    const double limit = kLargestOffset * solid.diagonal();
    offset = std::clamp(offset + lack / rate, -limit, limit);
    for (std::size_t a = 0; a < shapes.size(); ++a)
      for (std::size_t v = 0; v < outward[a].size(); ++v)
        partition.leaves[a].points[v] =
            project_into_cell(start.leaves[a].points[v] + offset * outward[a][v], shapes[a].cell, shapes[a].centre,
                              kOwnMargin * solid.diagonal());
    shapes = shapes_of(solid, partition);
    if (shapes.empty()) {
      partition = start;
      return;
    }
  }
}

}  // namespace decomposition
