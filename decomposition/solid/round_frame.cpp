// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/round_frame.h"

#include <cmath>
#include <limits>

#include "catalog/mass_properties.h"
#include "decomposition/geometry/random.h"

namespace decomposition {
namespace {

/// Longest over shortest semi-axis of the ellipsoid with the same second moments, up to which a body is left as it is.
/// Fits of ellipsoids 5 : 1 : 1 are as good as of balls, those of 10 : 1 : 1 begin to lose corners to the rules.
constexpr double kLongestCompact = 6;

/// A point near p on a grid that is coarse against the body: taking it from coordinates near by is exact, and bodies
/// drawn around the origin keep it.
double on_coarse_grid(double coordinate, double diagonal) {
  const double pitch = std::exp2(std::ceil(std::log2(diagonal)));
  return pitch * std::round(coordinate / pitch);
}

}  // namespace

RoundFrame::RoundFrame(const catalog::TriangleMesh& mesh) {
  const catalog::VolumeMoments moments = catalog::volume_moments(mesh);
  catalog::Matrix3 covariance = moments.second;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      covariance[i][j] = (covariance[i][j] - moments.first[i] * moments.first[j] / moments.volume) / moments.volume;
  catalog::Point variances;
  catalog::Matrix3 axes;
  catalog::symmetric_eigen(covariance, variances, axes);
  is_identity_ = !(variances[0] > 0 && variances[2] > kLongestCompact * kLongestCompact * variances[0]);
  if (is_identity_) return;
  std::vector<Vec3> vertices;
  for (const catalog::Point& p : mesh.vertices) vertices.push_back(to_vec3(p));
  const double diagonal = bounding_box(vertices).diagonal();
  centre_ = {on_coarse_grid(moments.first[0] / moments.volume, diagonal),
             on_coarse_grid(moments.first[1] / moments.volume, diagonal),
             on_coarse_grid(moments.first[2] / moments.volume, diagonal)};
  for (std::size_t a = 0; a < 3; ++a) {
    axes_[a] = to_vec3(axes[a]);
    // Powers of two: scaling rounds nothing, so that drawn bodies come back exactly.
    stretch_[a] = std::exp2(std::round(0.5 * std::log2(variances[a] / variances[0])));
  }
}

catalog::TriangleMesh RoundFrame::to_round(catalog::TriangleMesh mesh) const {
  for (catalog::Point& point : mesh.vertices) {
    const Vec3 p = to_vec3(point) - centre_;
    for (std::size_t a = 0; a < 3; ++a) point[a] = dot(axes_[a], p) / stretch_[a];
  }
  return mesh;
}

Vec3 RoundFrame::to_real(const Vec3& p) const {
  if (is_identity_) return p;
  return (stretch_[0] * p.x) * axes_[0] + (stretch_[1] * p.y) * axes_[1] + (stretch_[2] * p.z) * axes_[2] + centre_;
}

Plane RoundFrame::to_real(const Plane& plane) const {
  if (is_identity_) return plane;
  // Normals by the inverse transpose.
  const Vec3& n = plane.normal;
  const Vec3 normal = (n.x / stretch_[0]) * axes_[0] + (n.y / stretch_[1]) * axes_[1] + (n.z / stretch_[2]) * axes_[2];
  const double length = norm(normal);
  const Vec3 unit = (1 / length) * normal;
  return {unit, plane.offset / length + dot(unit, centre_)};
}

double smallest_extent(const std::vector<Vec3>& points, const RoundFrame& frame) {
  double thickness = std::numeric_limits<double>::infinity();
  constexpr int kSpread = 200;
  for (int d = 0; d < kSpread + 3; ++d) {
    const Vec3 axis{d == kSpread ? 1.0 : 0.0, d == kSpread + 1 ? 1.0 : 0.0, d == kSpread + 2 ? 1.0 : 0.0};
    const Vec3 direction = frame.to_real(Plane{d < kSpread ? spread_direction(d, 2 * kSpread) : axis, 0}).normal;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& p : points) {
      low = std::fmin(low, dot(direction, p));
      high = std::fmax(high, dot(direction, p));
    }
    thickness = std::fmin(thickness, high - low);
  }
  return thickness;
}

}  // namespace decomposition
