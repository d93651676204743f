// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/registration/fine_alignment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surface_reconstruction.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kNormalCosine = std::numbers::sqrt2 / 2;  // 45 degrees: noise turns normals by less
constexpr int kLargestIterations = 40;
constexpr double kConverged = 1e-7;      // step of the points farthest out / diagonal
constexpr int kNoiseNeighbours = 6;      // points whose distance from a point's plane tells the noise
constexpr double kAgreeSpacing = 0.3;    // distance from the plane / spacing that curvature may cause
constexpr double kAgreeNoise = 3;        // and / noise
constexpr double kPartnerReach = 2;      // of points that agree / spacing
constexpr double kContradictReach = 4;   // within which a point says something about the target / spacing
constexpr double kContradictFactor = 3;  // from which a distance from the plane contradicts / that which agrees

/// Median distance of neighbours from each point's plane, as a standard deviation. Curvature adds to it.
double plane_noise(const PointCloud& cloud) {
  std::vector<double> distances;
  const auto neighbours = nearest_points(cloud.points, cloud.points, kNoiseNeighbours + 1);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    for (const int n : neighbours[i])
      if (n != static_cast<int>(i))
        distances.push_back(std::abs(dot(cloud.normals[i], subtract(cloud.points[n], cloud.points[i]))));
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return 1.4826 * *middle / std::numbers::sqrt2;  // of a normal distribution; a difference has twice the variance
}

/// One step: the small rotation about `centre` and the shift that bring the pairs' residuals to zero.
RigidMotion step(const PointCloud& moving, const AlignmentTarget& target, const PairLimits& limits,
                 const Point& centre) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6 right = Vector6::Zero();
  for (std::size_t i = 0; i < moving.points.size(); ++i) {
    const int partner = target.nearest(moving.points[i]);
    const Point& normal = target.cloud.normals[partner];
    const Point way = subtract(moving.points[i], target.cloud.points[partner]);
    if (dot(normal, moving.normals[i]) < kNormalCosine || dot(way, way) > limits.reach * limits.reach) continue;
    const double residual = dot(normal, way), part = residual / limits.residual;
    if (std::abs(part) >= 1) continue;
    const double weight = (1 - part * part) * (1 - part * part);
    const Point turn = cross(subtract(moving.points[i], centre), normal);
    const Vector6 row = (Vector6() << turn[0], turn[1], turn[2], normal[0], normal[1], normal[2]).finished();
    matrix += weight * row * row.transpose();
    right -= weight * residual * row;
  }
  const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, 6, 6>> solver(matrix);
  const Vector6 solution = solver.solve(right);
  const Eigen::Vector3d turn = solution.head<3>();
  const double angle = turn.norm();
  RigidMotion motion;
  if (angle > 0) {
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) motion.rotation[r][c] = rotation(r, c);
  }
  motion.shift = add(subtract(centre, turned(motion, centre)), {solution[3], solution[4], solution[5]});
  return motion;
}

}  // namespace

AlignmentTarget::AlignmentTarget(PointCloud oriented)
    : cloud(std::move(oriented)),
      nearest(cloud.points),
      spacing(average_spacing(cloud.points)),
      noise(plane_noise(cloud)) {}

FineAlignment finely_aligned(const PointCloud& moving, const AlignmentTarget& target, const RigidMotion& start,
                             const PairLimits& limits) {
  FineAlignment result{start, 0};
  const double diagonal = bounding_diagonal(moving.points);
  Point centre{};
  for (const Point& point : moving.points) centre = add(centre, point);
  centre = scaled(centre, 1 / static_cast<double>(moving.points.size()));
  PointCloud placed = moved(start, moving);
  while (result.iterations < kLargestIterations) {
    const Point middle = moved(result.motion, centre);
    const RigidMotion change = step(placed, target, limits, middle);
    result.motion = chained(change, result.motion);
    ++result.iterations;
    placed = moved(result.motion, moving);
    if (rotation_angle(change) + distance(moved(change, middle), middle) / diagonal < kConverged) break;
  }
  return result;
}

AlignmentFit alignment_fit(const PointCloud& moving, const AlignmentTarget& target, const RigidMotion& motion) {
  const double agreeing = std::max(kAgreeSpacing * target.spacing, kAgreeNoise * target.noise);
  double agree = 0, contradict = 0, squares = 0;
  for (std::size_t i = 0; i < moving.points.size(); ++i) {
    const Point point = moved(motion, moving.points[i]);
    const int partner = target.nearest(point);
    const Point way = subtract(point, target.cloud.points[partner]);
    const double length = norm(way);
    if (length > std::max(kContradictReach * target.spacing, 2 * kContradictFactor * agreeing)) continue;
    const double residual = dot(target.cloud.normals[partner], way);
    const bool is_alike = dot(target.cloud.normals[partner], turned(motion, moving.normals[i])) >= kNormalCosine;
    if (is_alike && std::abs(residual) <= agreeing && length <= kPartnerReach * target.spacing + agreeing) {
      ++agree;
      squares += residual * residual;
    } else if (!is_alike || std::abs(residual) > kContradictFactor * agreeing) {
      ++contradict;
    }
  }
  AlignmentFit fit;
  if (agree == 0) return fit;
  fit.overlap = agree / static_cast<double>(moving.points.size());
  fit.consistency = agree / (agree + contradict);
  fit.rms = std::sqrt(squares / agree);
  return fit;
}

}  // namespace shape_pipeline
