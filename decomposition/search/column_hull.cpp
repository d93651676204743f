// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/search/column_hull.h"

#include <algorithm>
#include <array>
#include <limits>

#include "decomposition/geometry/small_hull.h"

namespace decomposition {
namespace {

// Of the slab between a face and the farthest point beyond it the hull fills a third if that is the only one, up to all
// if there are many.
constexpr double kFilledShare = 0.5;
constexpr double kOffset = 1e-6;  // share of the piece's extent

struct Support {
  Vec3 place;
  double reach = -std::numeric_limits<double>::infinity();
};

/// Block by block, with a maximum for each of four lanes: so that the loop keeps no index and waits for no comparison.
Support farthest(const std::vector<Stretch>& columns, const Vec3& direction) {
  constexpr std::size_t kLanes = 4, kBlock = 64;
  const bool is_up = direction.z > 0;
  const auto reach_of = [&](const Stretch& s) {
    return direction.x * s.x + direction.y * s.y + direction.z * (is_up ? s.high : s.low);
  };
  Support support;
  std::size_t best_block = 0;
  for (std::size_t block = 0; block < columns.size(); block += kBlock) {
    const std::size_t end = std::min(block + kBlock, columns.size()), whole = block + (end - block) / kLanes * kLanes;
    std::array<double, kLanes> most;
    most.fill(support.reach);
    for (std::size_t c = block; c < whole; c += kLanes)
      for (std::size_t lane = 0; lane < kLanes; ++lane) most[lane] = std::max(most[lane], reach_of(columns[c + lane]));
    for (std::size_t c = whole; c < end; ++c) most[0] = std::max(most[0], reach_of(columns[c]));
    const double farthest = *std::max_element(most.begin(), most.end());
    if (farthest > support.reach) support.reach = farthest, best_block = block;
  }
  for (std::size_t c = best_block; c < columns.size(); ++c)
    if (const Stretch& s = columns[c]; reach_of(s) == support.reach) {
      support.place = {s.x, s.y, is_up ? s.high : s.low};
      break;
    }
  return support;
}

/// Support points, each found once, set off a little so that those on one cut plane are in general position.
class SupportPoints {
 public:
  explicit SupportPoints(double offset) : offset_(offset) {}

  void add(const Vec3& place, const Vec3& direction) {
    const bool is_known = std::any_of(places_.begin(), places_.end(), [&](const Vec3& p) {
      return p.x == place.x && p.y == place.y && p.z == place.z;
    });
    if (is_known || static_cast<int>(places_.size()) == SmallHull::kMaxPoints) return;
    places_.push_back(place);
    points_.push_back(place + offset_ * normalized(direction));
  }
  const std::vector<Vec3>& points() const { return points_; }

 private:
  double offset_;
  std::vector<Vec3> places_, points_;
};

}  // namespace

PartFit column_hull(const std::vector<Stretch>& columns, int directions, int rounds) {
  if (columns.empty()) return {};
  const Stretch &first = columns.front(), &last = columns.back();
  SupportPoints support(kOffset * (std::abs(last.y - first.y) + first.high - first.low));
  for (int d = 0; d < directions; ++d) {
    const Vec3 direction = spread_direction(d, directions);
    support.add(farthest(columns, direction).place, direction);
  }
  const std::vector<Vec3>& points = support.points();
  SmallHull hull;
  if (!hull.build(points)) return {};
  PartFit fit;
  for (int round = 0; round <= rounds; ++round) {
    const std::vector<std::array<int, 3>> faces = hull.faces();
    fit.points.clear();
    for (std::size_t v = 0; v < points.size(); ++v)
      if (hull.is_vertex(static_cast<int>(v))) fit.points.push_back(points[v]);
    fit.volume = hull.volume();
    for (const auto& [a, b, c] : faces) {
      const Vec3 corner = points[static_cast<std::size_t>(a)];
      const Vec3 twice_area =
          cross(points[static_cast<std::size_t>(b)] - corner, points[static_cast<std::size_t>(c)] - corner);
      const Support beyond = farthest(columns, twice_area);
      fit.volume += 0.5 * kFilledShare * std::max(0.0, beyond.reach - dot(twice_area, corner));
      if (round < rounds && norm(twice_area) > 0) support.add(beyond.place, twice_area);
    }
    if (round < rounds && !hull.build(points)) return {};
  }
  return fit;
}

}  // namespace decomposition
