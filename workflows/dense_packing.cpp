// SPDX-License-Identifier: Apache-2.0
#include "workflows/dense_packing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace workflows {
namespace {

// Columns tried for each ball: more give a denser packing, in proportion to the time.
constexpr int kColumns = 60;
// Balls stand this share of their radius further apart than touching: far above rounding.
constexpr double kApart = 1e-9;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Frame with `up` as third axis; heights and columns are measured in it.
struct Frame {
  Point along, across, up;

  explicit Frame(const Point& up) : up(up) {
    const Point trial = std::abs(up[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
    along = trial;
    for (int i = 0; i < 3; ++i) along[i] -= dot(trial, up) * up[i];
    const double length = std::sqrt(dot(along, along));
    for (double& component : along) component /= length;
    across = {up[1] * along[2] - up[2] * along[1], up[2] * along[0] - up[0] * along[2],
              up[0] * along[1] - up[1] * along[0]};
  }
  Point into(const Point& p) const { return {dot(p, along), dot(p, across), dot(p, up)}; }
  Point out_of(const Point& p) const {
    Point world{};
    for (int i = 0; i < 3; ++i) world[i] = p[0] * along[i] + p[1] * across[i] + p[2] * up[i];
    return world;
  }
};

using Interval = std::pair<double, double>;

/// Cuts `heights` to low <= offset + slope * h <= high; false if nothing is left.
bool clip(Interval& heights, double offset, double slope, double low, double high) {
  if (std::abs(slope) < 1e-12) return offset >= low && offset <= high;
  double from = (low - offset) / slope, to = (high - offset) / slope;
  if (from > to) std::swap(from, to);
  heights = {std::max(heights.first, from), std::min(heights.second, to)};
  return heights.first <= heights.second;
}

/// Heights h for which the ball about foot + h * up lies inside the region.
std::optional<Interval> heights_inside(const FillRegion& region, const Point& foot, const Point& up, double radius) {
  Interval heights{-1e300, 1e300};
  if (const auto* box = std::get_if<BoxRegion>(&region)) {
    for (int i = 0; i < 3; ++i)
      if (!clip(heights, foot[i], up[i], box->low[i] + radius, box->high[i] - radius)) return std::nullopt;
    return heights;
  }
  const auto& cylinder = std::get<CylinderRegion>(region);
  const double room = cylinder.radius - radius;
  if (room < 0) return std::nullopt;
  Point from_base{};
  for (int i = 0; i < 3; ++i) from_base[i] = foot[i] - cylinder.base[i];
  const double along = dot(from_base, cylinder.axis), slope = dot(up, cylinder.axis);
  if (!clip(heights, along, slope, radius, cylinder.length - radius)) return std::nullopt;
  // Off the axis: |q + h v|^2 <= room^2 with the parts of foot and up at right angles to it.
  Point q{}, v{};
  for (int i = 0; i < 3; ++i) {
    q[i] = from_base[i] - along * cylinder.axis[i];
    v[i] = up[i] - slope * cylinder.axis[i];
  }
  const double a = dot(v, v), b = dot(q, v), c = dot(q, q) - room * room;
  if (a < 1e-12) return c <= 0 ? std::optional(heights) : std::nullopt;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  heights = {std::max(heights.first, (-b - root) / a), std::min(heights.second, (-b + root) / a)};
  return heights.first <= heights.second ? std::optional(heights) : std::nullopt;
}

struct Ball {
  Point centre;  // in the frame
  double radius;
};

/// Balls set so far, by square column of the largest diameter.
class Columns {
 public:
  explicit Columns(double largest_radius) : width_(2 * largest_radius) {}

  void add(const Ball& ball) { columns_[key(ball.centre[0], ball.centre[1])].push_back(ball); }

  /// Lowest free height of a ball in the column through (x, y).
  std::optional<double> lowest(double x, double y, double radius, const Interval& heights) const {
    std::vector<Interval> blocked;
    const auto [column, row] = key(x, y);
    for (int i = column - 1; i <= column + 1; ++i)
      for (int j = row - 1; j <= row + 1; ++j) {
        const auto found = columns_.find({i, j});
        if (found == columns_.end()) continue;
        for (const Ball& ball : found->second) {
          const double reach = (radius + ball.radius) * (1 + kApart);
          const double aside = std::hypot(x - ball.centre[0], y - ball.centre[1]);
          if (aside >= reach) continue;
          const double half = std::sqrt(reach * reach - aside * aside);
          blocked.push_back({ball.centre[2] - half, ball.centre[2] + half});
        }
      }
    std::sort(blocked.begin(), blocked.end());
    double height = heights.first;
    for (const auto& [from, to] : blocked)
      if (from < height && to > height) height = to;
    return height <= heights.second ? std::optional(height) : std::nullopt;
  }

 private:
  std::pair<int, int> key(double x, double y) const {
    return {static_cast<int>(std::floor(x / width_)), static_cast<int>(std::floor(y / width_))};
  }

  double width_;
  std::map<std::pair<int, int>, std::vector<Ball>> columns_;
};

/// The region's extent along a frame axis.
Interval extent(const FillRegion& region, const Point& axis) {
  if (const auto* cylinder = std::get_if<CylinderRegion>(&region)) {
    const double base = dot(cylinder->base, axis), along = dot(cylinder->axis, axis) * cylinder->length;
    const double aside = cylinder->radius * std::sqrt(std::max(0.0, 1 - std::pow(dot(cylinder->axis, axis), 2)));
    return {base + std::min(0.0, along) - aside, base + std::max(0.0, along) + aside};
  }
  const auto& box = std::get<BoxRegion>(region);
  Interval interval{0, 0};
  for (int i = 0; i < 3; ++i) {
    interval.first += std::min(box.low[i] * axis[i], box.high[i] * axis[i]);
    interval.second += std::max(box.low[i] * axis[i], box.high[i] * axis[i]);
  }
  return interval;
}

}  // namespace

std::vector<Point> dense_packing(const FillRegion& region, const std::vector<double>& radii, const Point& up,
                                 RandomStream& random) {
  const Frame frame(up);
  const Interval along = extent(region, frame.along), across = extent(region, frame.across);
  Columns columns(radii.empty() ? 1 : *std::max_element(radii.begin(), radii.end()) * (1 + kApart));
  std::vector<Point> centres;
  for (const double radius : radii) {
    std::optional<Point> best;
    for (int trial = 0; trial < kColumns; ++trial) {
      const double x = along.first + radius + random.uniform() * (along.second - along.first - 2 * radius);
      const double y = across.first + radius + random.uniform() * (across.second - across.first - 2 * radius);
      const auto heights = heights_inside(region, frame.out_of({x, y, 0}), up, radius);
      if (!heights) continue;
      const auto height = columns.lowest(x, y, radius, *heights);
      if (height && (!best || *height < (*best)[2])) best = Point{x, y, *height};
    }
    if (!best) break;
    columns.add({*best, radius});
    centres.push_back(frame.out_of(*best));
  }
  return centres;
}

}  // namespace workflows
