// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/solid_alignment.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/registration/fine_alignment.h"
#include "shape_pipeline/surface_distance.h"
#include "shape_pipeline/surfaces/cloud_cleaning.h"
#include "shape_pipeline/surfaces/vector3.h"
#include "shape_pipeline/surfaces/winding_volume.h"

namespace shape_pipeline {
namespace {

constexpr std::size_t kCoarsePoints = 500, kFinePoints = 4000;
// Over the diagonal. Tighter limits would fit the half of a poor capture that agrees, and tell the rest as its error.
constexpr PairLimits kLimits{0.3, 0.15};
constexpr double kLargestDistance = 0.05;  // mean / diagonal: beyond, they are two stones
constexpr double kSameAttitude = 0.35;     // [rad] apart, attitudes are two
constexpr double kLeastMargin = 1.1;       // next attitude's distance / the best's: below, the choice is a guess

PointCloud sampled(const catalog::TriangleMesh& mesh, std::size_t limit) {
  PointCloud cloud;
  for (const SurfaceElement& sample : surface_samples(mesh)) {
    cloud.points.push_back(sample.centre);
    cloud.normals.push_back(normalized(sample.area));
  }
  thin_out(cloud, limit);
  return cloud;
}

/// The 24 rotations that map the axes to axes.
std::vector<catalog::Matrix3> axis_attitudes() {
  std::vector<catalog::Matrix3> attitudes;
  std::array<int, 3> order{0, 1, 2};
  do {
    const bool is_even = (order[1] - order[0] + 3) % 3 == 1;
    for (int signs = 0; signs < 8; ++signs) {
      const bool has_even_signs = (signs == 0 || signs == 3 || signs == 5 || signs == 6);
      if (is_even != has_even_signs) continue;
      catalog::Matrix3 rotation{};
      for (int i = 0; i < 3; ++i) rotation[i][order[i]] = signs >> i & 1 ? -1 : 1;
      attitudes.push_back(rotation);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return attitudes;
}

/// Centroid and principal axes to the origin and the axes.
RigidMotion to_principal_frame(const catalog::TriangleMesh& mesh) {
  const catalog::MassProperties found = catalog::mass_properties(mesh);
  RigidMotion motion{found.principal_axes, {}};
  motion.shift = scaled(turned(motion, found.centroid), -1);
  return motion;
}

double mean_distance(const PointCloud& moving, const AlignmentTarget& target, const RigidMotion& motion) {
  double sum = 0;
  for (const Point& p : moving.points) {
    const Point point = moved(motion, p);
    sum += distance(point, target.cloud.points[target.nearest(point)]);
  }
  return sum / static_cast<double>(moving.points.size());
}

struct Attitude {
  RigidMotion motion;
  double distance;  // mean [m]
};

/// Centres of the sampled faces.
std::vector<Point> sample_points(const catalog::TriangleMesh& mesh) {
  constexpr std::size_t kSamples = 20000;
  return sampled(mesh, kSamples).points;
}

}  // namespace

SolidAlignment align_solids(const catalog::TriangleMesh& moving, const catalog::TriangleMesh& fixed) {
  const double diagonal = bounding_diagonal(fixed.vertices);
  const PairLimits limits{kLimits.reach * diagonal, kLimits.residual * diagonal};
  const AlignmentTarget target(sampled(fixed, kFinePoints));
  const PointCloud few = sampled(moving, kCoarsePoints), many = sampled(moving, kFinePoints);
  const RigidMotion from = to_principal_frame(moving), to = inverse(to_principal_frame(fixed));
  std::vector<Attitude> attitudes;
  for (const catalog::Matrix3& rotation : axis_attitudes()) {
    const RigidMotion start = chained(to, chained({rotation, {}}, from));
    const RigidMotion motion = finely_aligned(few, target, start, limits).motion;
    attitudes.push_back({motion, mean_distance(few, target, motion)});
  }
  std::stable_sort(attitudes.begin(), attitudes.end(),
                   [](const Attitude& a, const Attitude& b) { return a.distance < b.distance; });
  const Attitude& best = attitudes.front();
  const auto next = std::find_if(attitudes.begin(), attitudes.end(), [&](const Attitude& other) {
    return rotation_angle(chained(other.motion, inverse(best.motion))) > kSameAttitude;
  });
  const double margin = next == attitudes.end() ? 0 : next->distance / best.distance;

  SolidAlignment result;
  result.motion = finely_aligned(many, target, best.motion, limits).motion;
  const std::vector<double> distances = distances_to_surface(moved(result.motion, many).points, fixed);
  const double mean = distance_statistics(distances, diagonal).mean;
  char line[160];
  std::snprintf(line, sizeof line,
                "mean distance of the aligned surfaces is %.3f %% of the diagonal, expected at most %.0f %%",
                100 * mean, 100 * kLargestDistance);
  result.checks.push_back({"alignment_distance", mean <= kLargestDistance, mean, line});
  std::snprintf(line, sizeof line,
                "the next-best attitude has %.2f times the distance of the one taken, expected at least %.1f", margin,
                kLeastMargin);
  result.checks.push_back({"attitude_margin", next == attitudes.end() || margin >= kLeastMargin, margin, line});
  return result;
}

ShapeDifference shape_difference(const catalog::TriangleMesh& moved, const catalog::TriangleMesh& fixed) {
  const double diagonal = bounding_diagonal(fixed.vertices);
  ShapeDifference result;
  result.distances = signed_distances_to_surface(moved.vertices, fixed);
  const std::vector<double> signed_distances = signed_distances_to_surface(sample_points(moved), fixed);
  std::vector<double> lengths;
  for (const double distance : signed_distances) {
    result.mean_signed += distance / static_cast<double>(signed_distances.size());
    lengths.push_back(std::abs(distance));
  }
  result.from_moved = distance_statistics(lengths, diagonal);
  result.from_fixed = distance_statistics(distances_to_surface(sample_points(fixed), moved), diagonal);
  return result;
}

}  // namespace shape_pipeline
