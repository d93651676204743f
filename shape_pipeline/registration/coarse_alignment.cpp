// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/registration/coarse_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/cloud_cleaning.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr std::size_t kPoints = 1200;   // enough for facets and edges, few enough for thousands of trials
constexpr double kFeatureRadius = 5;    // / spacing: some eighty points
constexpr int kMatches = 8;             // points of like feature that each point may stand for
constexpr int kTrials = 60000;          // pairs of points drawn
constexpr double kLeastBase = 0.2;      // distance of the two points / diagonal: shorter, the attitude is loose
constexpr double kDistanceSlack = 1.5;  // of the two pairs' distances / spacing
constexpr double kCosineSlack = 0.2;    // of their normals' cosines: what noise and curvature turn them by
constexpr std::size_t kScorePoints = 150;
constexpr std::size_t kKept = 24;      // attitudes that are refined
constexpr double kSameAttitude = 0.2;  // [rad] within which two are one
constexpr std::size_t kRefinePoints = 400;

PointCloud thinned(PointCloud cloud, std::size_t limit) {
  thin_out(cloud, limit);
  return cloud;
}

/// The points of the fixed cloud whose features are nearest to each point's, nearest first.
std::vector<std::array<int, kMatches>> matches(const FeaturedCloud& moving, const FeaturedCloud& fixed) {
  std::vector<std::array<int, kMatches>> result(moving.features.size());
  std::vector<std::pair<float, int>> order(fixed.features.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t j = 0; j < order.size(); ++j) {
      float sum = 0;
      for (std::size_t k = 0; k < fixed.features[j].size(); ++k) {
        const float difference = moving.features[i][k] - fixed.features[j][k];
        sum += difference * difference;
      }
      order[j] = {sum, static_cast<int>(j)};
    }
    const std::size_t count = std::min<std::size_t>(kMatches, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
    for (std::size_t m = 0; m < kMatches; ++m) result[i][m] = order[std::min(m, count - 1)].second;
  }
  return result;
}

/// Two oriented points of a cloud.
struct PointPair {
  Point middle, axis;  // [m], unit
  Point first_normal, second_normal;
  double length;  // [m]
};

PointPair pair_of(const PointCloud& cloud, int first, int second) {
  const Point way = subtract(cloud.points[second], cloud.points[first]);
  return {scaled(add(cloud.points[first], cloud.points[second]), 0.5), normalized(way), cloud.normals[first],
          cloud.normals[second], norm(way)};
}

bool are_alike(const PointPair& a, const PointPair& b, double spacing) {
  const auto differ = [](double x, double y) { return std::abs(x - y) > kCosineSlack; };
  return std::abs(a.length - b.length) <= kDistanceSlack * spacing &&
         !differ(dot(a.axis, a.first_normal), dot(b.axis, b.first_normal)) &&
         !differ(dot(a.axis, a.second_normal), dot(b.axis, b.second_normal)) &&
         !differ(dot(a.first_normal, a.second_normal), dot(b.first_normal, b.second_normal));
}

/// Columns: the axis, the normals' mean across it, and their cross product. False if the mean lies along the axis.
bool frame_of(const PointPair& pair, std::array<Point, 3>& frame) {
  const Point mean = add(pair.first_normal, pair.second_normal);
  const Point across = subtract(mean, scaled(pair.axis, dot(mean, pair.axis)));
  if (norm(across) < 0.2) return false;
  frame = {pair.axis, normalized(across), cross(pair.axis, normalized(across))};
  return true;
}

bool motion_of(const PointPair& moving, const PointPair& fixed, RigidMotion& motion) {
  std::array<Point, 3> from, to;
  if (!frame_of(moving, from) || !frame_of(fixed, to)) return false;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      motion.rotation[r][c] = to[0][r] * from[0][c] + to[1][r] * from[1][c] + to[2][r] * from[2][c];
  motion.shift = {};
  motion.shift = subtract(fixed.middle, turned(motion, moving.middle));
  return true;
}

/// Share of the points that find a partner with its normal.
double quick_score(const PointCloud& moving, const AlignmentTarget& fixed, const RigidMotion& motion) {
  int agree = 0;
  for (std::size_t i = 0; i < moving.points.size(); ++i) {
    const Point point = moved(motion, moving.points[i]);
    const int partner = fixed.nearest(point);
    agree += distance(point, fixed.cloud.points[partner]) < 1.5 * fixed.spacing &&
             dot(turned(motion, moving.normals[i]), fixed.cloud.normals[partner]) > 0.85;
  }
  return static_cast<double>(agree) / static_cast<double>(moving.points.size());
}

using ScoredMotion = std::pair<double, RigidMotion>;

/// The motions of highest score of which no two are one.
std::vector<RigidMotion> best_apart(std::vector<ScoredMotion>& motions) {
  std::stable_sort(motions.begin(), motions.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<RigidMotion> kept;
  for (const auto& [score, motion] : motions) {
    if (kept.size() == kKept) break;
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&, turn = inverse(motion)](const RigidMotion& other) {
      return rotation_angle(chained(other, turn)) < kSameAttitude;
    });
    if (is_new) kept.push_back(motion);
  }
  return kept;
}

}  // namespace

FeaturedCloud::FeaturedCloud(const PointCloud& oriented)
    : target(thinned(oriented, kPoints)), features(point_features(target.cloud, kFeatureRadius * target.spacing)) {}

std::vector<Attitude> coarse_attitudes(const FeaturedCloud& moving, const FeaturedCloud& fixed, std::uint64_t seed) {
  RandomStream random(seed);
  const auto alike = matches(moving, fixed);
  const PointCloud& cloud = moving.target.cloud;
  const double spacing = std::max(moving.target.spacing, fixed.target.spacing);
  const double base = kLeastBase * bounding_diagonal(cloud.points);
  const PointCloud few = thinned(cloud, kScorePoints), more = thinned(cloud, kRefinePoints);
  const auto draw = [&](std::size_t count) { return static_cast<int>(random.uniform(0, static_cast<double>(count))); };
  std::vector<ScoredMotion> motions;
  for (int trial = 0; trial < kTrials; ++trial) {
    const int first = draw(alike.size()), second = draw(alike.size());
    const int first_match = alike[first][draw(kMatches)], second_match = alike[second][draw(kMatches)];
    const PointPair pair = pair_of(cloud, first, second);
    if (pair.length < base || first_match == second_match) continue;
    const PointPair partner = pair_of(fixed.target.cloud, first_match, second_match);
    RigidMotion motion;
    if (are_alike(pair, partner, spacing) && motion_of(pair, partner, motion))
      motions.emplace_back(quick_score(few, fixed.target, motion), motion);
  }
  std::vector<Attitude> attitudes;
  for (const RigidMotion& start : best_apart(motions)) {
    const RigidMotion near = finely_aligned(more, fixed.target, start, {3 * spacing, 1.5 * spacing}).motion;
    const RigidMotion fine = finely_aligned(more, fixed.target, near, {2 * spacing, 0.5 * spacing}).motion;
    attitudes.push_back({fine, alignment_fit(more, fixed.target, fine)});
  }
  std::stable_sort(attitudes.begin(), attitudes.end(),
                   [](const Attitude& a, const Attitude& b) { return a.fit.score() > b.fit.score(); });
  return attitudes;
}

}  // namespace shape_pipeline
