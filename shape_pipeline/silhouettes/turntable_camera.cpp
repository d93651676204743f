// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/silhouettes/turntable_camera.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape_pipeline/reading/scan_bytes.h"

namespace shape_pipeline {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kLargestGap = 100 * std::numbers::pi / 180;  // between views, for the axis to be found
constexpr std::size_t kLeastViewsForAxis = 4;

double largest_gap(const std::vector<double>& angles) {
  std::vector<double> sorted;
  for (const double angle : angles) sorted.push_back(angle - kTurn * std::floor(angle / kTurn));
  std::sort(sorted.begin(), sorted.end());
  double gap = sorted.front() + kTurn - sorted.back();
  for (std::size_t k = 1; k < sorted.size(); ++k) gap = std::max(gap, sorted[k] - sorted[k - 1]);
  return gap;
}

}  // namespace

std::vector<double> view_angles(const TurntableCamera& camera, std::size_t views) {
  std::vector<double> angles = camera.angles;
  if (angles.empty())
    for (std::size_t k = 0; k < views; ++k)
      angles.push_back(kTurn * static_cast<double>(k) / static_cast<double>(views));
  if (camera.turns_clockwise)
    for (double& angle : angles) angle = -angle;
  return angles;
}

TurntableProjection::TurntableProjection(const TurntableCamera& camera, double angle, int image_height)
    : cosine_(std::cos(angle)),
      sine_(std::sin(angle)),
      cosine_up_(std::cos(camera.elevation)),
      sine_up_(std::sin(camera.elevation)),
      scale_(camera.is_perspective ? camera.focal_length : 1 / camera.pixel_size),
      distance_(camera.is_perspective ? camera.distance : 0),
      column_(camera.is_perspective ? camera.principal_point[0] : camera.axis_column.value()),
      row_(camera.is_perspective ? camera.principal_point[1] : image_height / 2.0) {
  if (camera.is_perspective)
    shift_ = (camera.axis_column.value() - camera.principal_point[0]) * camera.distance / camera.focal_length;
}

ImagePoint TurntableProjection::operator()(const catalog::Point& point) const {
  const double x = cosine_ * point[0] - sine_ * point[1], y = sine_ * point[0] + cosine_ * point[1];
  const double up = y * sine_up_ + point[2] * cosine_up_;
  const double depth = distance_ + y * cosine_up_ - point[2] * sine_up_;
  const double scale = distance_ > 0 ? scale_ / depth : scale_;
  return {column_ + scale * (x + shift_), row_ - scale * up, 1 / scale};
}

AxisEstimate estimated_axis(const TurntableCamera& camera, const std::vector<double>& angles,
                            const std::vector<ColumnExtent>& extents, const std::filesystem::path& name) {
  if (angles.size() < kLeastViewsForAxis || largest_gap(angles) > kLargestGap)
    refuse_file(name, "", "the rotation axis cannot be found from fewer than 4 views or across a gap above 100 degrees",
                "state \"axis_column\" in turntable.json");
  const auto sight = [&](double column) {
    return camera.is_perspective ? std::atan((column - camera.principal_point[0]) / camera.focal_length) : column;
  };
  const auto rows = static_cast<Eigen::Index>(angles.size());
  const Eigen::Index harmonics = rows >= 8 ? 2 : 1;
  Eigen::MatrixXd terms(rows, 1 + 2 * harmonics);
  Eigen::VectorXd middles(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto view = static_cast<std::size_t>(k);
    middles[k] = (sight(extents[view][0]) + sight(extents[view][1])) / 2;
    terms(k, 0) = 1;
    for (Eigen::Index h = 0; h < harmonics; ++h) {
      const double phase = static_cast<double>(2 * h + 1) * angles[view];
      terms(k, 1 + 2 * h) = std::cos(phase);
      terms(k, 2 + 2 * h) = std::sin(phase);
    }
  }
  const Eigen::VectorXd found = terms.colPivHouseholderQr().solve(middles);
  const double scatter = (terms * found - middles).norm() / std::sqrt(static_cast<double>(rows));
  if (!camera.is_perspective) return {found[0], scatter};
  return {camera.principal_point[0] + camera.focal_length * std::tan(found[0]), camera.focal_length * scatter};
}

}  // namespace shape_pipeline
