// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/registration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "catalog/input_error.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/registration/coarse_alignment.h"
#include "shape_pipeline/surfaces/cloud_cleaning.h"
#include "shape_pipeline/surfaces/cloud_normals.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr int kNormalNeighbours = 18;         // points of a tangent plane: less follows noise, more rounds edges
constexpr std::size_t kPartPoints = 60000;    // of a part: what a reconstruction keeps of a whole particle
constexpr std::size_t kFinePoints = 6000;     // of a part, for closest points
constexpr std::size_t kTargetPoints = 30000;  // that they are sought among
constexpr std::size_t kTriedAttitudes = 4;
constexpr double kLargestSizeRatio = 5;  // of two parts' diagonals: parts of one particle differ by less
constexpr double kLeastOverlap = 0.15;
constexpr double kLeastConsistency = 0.8;
constexpr int kRounds = 3;             // of each part against all others
constexpr double kPairOverlap = 0.02;  // below, two parts do not meet

Point mean_point(const std::vector<Point>& points) {
  Point sum{};
  for (const Point& point : points) sum = add(sum, point);
  return scaled(sum, 1 / static_cast<double>(points.size()));
}

/// Without strays, with outward normals: away from the mean point, which lies behind most of a part's surface.
PointCloud prepared(PointCloud cloud, std::size_t& thinned) {
  merge_duplicate_points(cloud);
  if (cloud.points.size() > kPartPoints) thinned += thin_out(cloud, kPartPoints);
  remove_outliers(cloud);
  PointCloud result = with_estimated_normals({cloud.points, {}}, kNormalNeighbours);
  const Point mean = mean_point(result.points);
  double outward = 0;
  for (std::size_t i = 0; i < result.points.size(); ++i)
    outward += dot(result.normals[i], subtract(result.points[i], mean));
  if (outward < 0)
    for (Point& normal : result.normals) normal = scaled(normal, -1);
  return result;
}

void refuse_other_units(const std::vector<PartialScan>& parts) {
  const double first = bounding_diagonal(parts.front().cloud.points);
  for (const PartialScan& part : parts) {
    const double ratio = bounding_diagonal(part.cloud.points) / first;
    if (ratio <= kLargestSizeRatio && ratio >= 1 / kLargestSizeRatio) continue;
    char text[160];
    std::snprintf(text, sizeof text, " is %.3g times as large as ", ratio);
    throw catalog::InputError(part.name + text + parts.front().name +
                              "; parts of one particle differ less: bring them to one unit");
  }
}

PointCloud thinned(PointCloud cloud, std::size_t limit) {
  if (cloud.points.size() > limit) thin_out(cloud, limit);
  return cloud;
}

void append(PointCloud& cloud, const PointCloud& more) {
  cloud.points.insert(cloud.points.end(), more.points.begin(), more.points.end());
  cloud.normals.insert(cloud.normals.end(), more.normals.begin(), more.normals.end());
}

/// From near to the last digit that the noise leaves.
RigidMotion refined(const PointCloud& part, const AlignmentTarget& target, RigidMotion motion) {
  const double last = std::max(0.3 * target.spacing, 4 * target.noise);
  for (const double residual : {2 * target.spacing, target.spacing, last})
    motion = finely_aligned(part, target, motion, {2 * target.spacing + residual, residual}).motion;
  return motion;
}

class Registration {
 public:
  explicit Registration(const std::vector<PartialScan>& parts) : parts_(parts), motions_(parts.size()) {
    for (const PartialScan& part : parts) {
      clouds_.push_back(prepared(part.cloud, thinned_));
      fine_.push_back(thinned(clouds_.back(), kFinePoints));
    }
  }

  /// Joins the parts to the first, the one that fits best before the others.
  void join(std::uint64_t seed) {
    std::vector<std::size_t> joined{0}, open;
    for (std::size_t p = 1; p < parts_.size(); ++p) open.push_back(p);
    while (!open.empty()) {
      const PointCloud whole = together(joined);
      const FeaturedCloud featured(whole);
      const AlignmentTarget target(thinned(whole, kTargetPoints));
      Attitude best;
      std::size_t chosen = open.front();
      for (const std::size_t p : open) {
        const Attitude found = attitude(p, featured, target, seed);
        if (!(found.fit.score() > best.fit.score())) continue;
        best = found;
        chosen = p;
      }
      refuse_misfit(chosen, best.fit);
      motions_[chosen] = best.motion;
      joined.push_back(chosen);
      std::erase(open, chosen);
    }
  }

  /// Spreads the errors of the chain over all parts.
  void settle() {
    if (parts_.size() < 3) return;
    for (int round = 0; round < kRounds; ++round)
      for (std::size_t p = 1; p < parts_.size(); ++p)
        motions_[p] = refined(fine_[p], AlignmentTarget(thinned(all_but(p), kTargetPoints)), motions_[p]);
  }

  RegisteredParts result() const {
    RegisteredParts registered;
    registered.motions = motions_;
    double squares = 0, least_overlap = 1;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      append(registered.merged, moved(motions_[p], clouds_[p]));
      const AlignmentFit fit =
          alignment_fit(fine_[p], AlignmentTarget(thinned(all_but(p), kTargetPoints)), motions_[p]);
      refuse_misfit(p, fit);
      squares += fit.rms * fit.rms / static_cast<double>(parts_.size());
      least_overlap = std::min(least_overlap, fit.overlap);
    }
    registered.checks = {
        {"registered_parts", true, static_cast<double>(parts_.size()), "partial scans brought together"},
        {"registration_rms", true, std::sqrt(squares), "distance of the parts from one another where they overlap [m]"},
        {"registration_overlap", least_overlap >= kLeastOverlap, least_overlap,
         "least share of a part that lies on others, expected at least 0.15"}};
    if (thinned_ > 0)
      registered.checks.push_back({"registration_thinned", true, static_cast<double>(thinned_),
                                   "points left out where the parts are dense, 60000 a part kept"});
    add_pairs(registered);
    return registered;
  }

 private:
  Attitude attitude(std::size_t p, const FeaturedCloud& featured, const AlignmentTarget& target,
                    std::uint64_t seed) const {
    std::vector<Attitude> attitudes = coarse_attitudes(FeaturedCloud(clouds_[p]), featured, seed);
    attitudes.resize(std::min(attitudes.size(), kTriedAttitudes));
    Attitude best;
    for (const Attitude& start : attitudes) {
      const RigidMotion motion = refined(fine_[p], target, start.motion);
      const AlignmentFit fit = alignment_fit(fine_[p], target, motion);
      if (fit.score() > best.fit.score()) best = {motion, fit};
    }
    return best;
  }

  void refuse_misfit(std::size_t p, const AlignmentFit& fit) const {
    if (fit.overlap >= kLeastOverlap && fit.consistency >= kLeastConsistency) return;
    char text[240];
    std::snprintf(text, sizeof text,
                  ": does not fit the other parts: at best %.0f %% of it lies on them (expected at least %.0f %%), and "
                  "of what meets them %.0f %% agrees (expected at least %.0f %%)",
                  100 * fit.overlap, 100 * kLeastOverlap, 100 * fit.consistency, 100 * kLeastConsistency);
    throw catalog::InputError(parts_[p].name + text +
                              "; scan sides that overlap by a third, or leave out parts of another particle");
  }

  PointCloud together(const std::vector<std::size_t>& chosen) const {
    PointCloud whole;
    for (const std::size_t p : chosen) append(whole, moved(motions_[p], clouds_[p]));
    return whole;
  }

  PointCloud all_but(std::size_t part) const {
    std::vector<std::size_t> others;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (p != part) others.push_back(p);
    return together(others);
  }

  void add_pairs(RegisteredParts& registered) const {
    for (std::size_t a = 0; a < parts_.size(); ++a) {
      const AlignmentTarget target(moved(motions_[a], fine_[a]));
      for (std::size_t b = a + 1; b < parts_.size(); ++b) {
        const AlignmentFit fit = alignment_fit(fine_[b], target, motions_[b]);
        if (fit.overlap < kPairOverlap) continue;
        registered.pairs.push_back({a, b, fit.overlap, fit.rms});
        char text[120];
        std::snprintf(text, sizeof text, "distance of parts %zu and %zu [m]; %.0f %% of the second lies on the first",
                      a + 1, b + 1, 100 * fit.overlap);
        char name[64];
        std::snprintf(name, sizeof name, "registration_pair_%zu_%zu", a + 1, b + 1);
        registered.checks.push_back({name, true, fit.rms, text});
      }
    }
  }

  const std::vector<PartialScan>& parts_;
  std::vector<PointCloud> clouds_, fine_;
  std::vector<RigidMotion> motions_;
  std::size_t thinned_ = 0;  // points left out of dense parts
};

}  // namespace

RegisteredParts register_parts(const std::vector<PartialScan>& parts, std::uint64_t seed) {
  if (parts.size() < 2)
    throw catalog::InputError((parts.empty() ? std::string("no part") : parts.front().name) +
                              ": registration needs two partial scans or more; name them all");
  refuse_other_units(parts);
  Registration registration(parts);
  registration.join(seed);
  registration.settle();
  return registration.result();
}

}  // namespace shape_pipeline
