// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/periodic/wall_extent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "dem_gpu/meshes/contact_surface.h"
#include "dem_gpu/walls/wall_motion.h"

namespace dem_gpu {
namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;
/// Corners of the polygon about a rim that stands for it as it turns: wider by 0.12 %.
constexpr int kRimCorners = 64;

struct Rim {
  Vec3 centre, normal;
  Real radius;
};

/// What bounds a wall's surface: rims of discs, cylinders and cones, balls, corners (balls of no radius).
struct Bounds {
  std::vector<Rim> rims;
  struct Sphere {
    Vec3 centre;
    Real radius;
  };
  std::vector<Sphere> balls;

  void operator()(const Plane&) {}
  void operator()(const Disc& disc) {
    rims.push_back({disc.centre, disc.normal, disc.radius});
    rims.push_back({disc.centre - disc.thickness.value_or(0) * disc.normal, disc.normal, disc.radius});
  }
  void operator()(const Cylinder& cylinder) {
    rims.push_back({cylinder.base, cylinder.axis, cylinder.radius});
    rims.push_back({cylinder.base + cylinder.length * cylinder.axis, cylinder.axis, cylinder.radius});
  }
  void operator()(const Cone& cone) {
    rims.push_back({cone.base, cone.axis, cone.base_radius});
    rims.push_back({cone.base + cone.length * cone.axis, cone.axis, cone.top_radius});
  }
  void operator()(const Ball& ball) { balls.push_back({ball.centre, ball.radius}); }
  void operator()(const VolumeObject& object) { add_corners(object.part.vertices); }
  void operator()(const MeshObject& object) {
    add_corners(object.thickness ? contact_surface(object).vertices : object.mesh.vertices);
  }

  template <class Points>
  void add_corners(const Points& points) {
    for (const auto& p : points) balls.push_back({{p[0], p[1], p[2]}, 0});
  }
};

Bounds bounds_of(const Wall& wall) {
  Bounds bounds;
  std::visit([&](const auto& geometry) { bounds(geometry); }, wall.geometry);
  return bounds;
}

constexpr Extent kNothing{std::numeric_limits<Real>::max(), std::numeric_limits<Real>::lowest()};

void include(Extent& extent, const Extent& other) {
  extent = {std::min(extent.low, other.low), std::max(extent.high, other.high)};
}

/// Turns about one axis through `centre` by angles from `low` to `high` [rad].
struct Turning {
  Vec3 centre, axis;  // unit
  Real low = 0, high = 0;

  /// Along `along_axis`, of the arc on which a point goes: base + reach cos(phase + angle).
  Extent arc(const Vec3& point, int along_axis) const {
    const Vec3 arm = point - centre, on_axis = dot(arm, axis) * axis;
    const Real base = component(centre + on_axis, along_axis), cosine = component(arm - on_axis, along_axis),
               sine = -component(cross(axis, arm), along_axis);
    const Real reach = std::hypot(cosine, sine), from = std::atan2(sine, cosine) + low,
               to = from + std::min(high - low, 2 * kPi);
    Extent extent{std::min(std::cos(from), std::cos(to)), std::max(std::cos(from), std::cos(to))};
    // A crest or trough of the cosine between.
    if (std::floor(to / (2 * kPi)) > std::floor(from / (2 * kPi))) extent.high = 1;
    if (std::floor((to - kPi) / (2 * kPi)) > std::floor((from - kPi) / (2 * kPi))) extent.low = -1;
    return {base + reach * extent.low, base + reach * extent.high};
  }
};

/// Along `axis`, of the way of a point of the wall as it turns.
class TurningPath {
 public:
  TurningPath(const Motion& motion, Real until) : centre_(motion.rotation_centre) {
    const MotionRange range = motion_range(motion, until);
    const Real rate = norm(motion.angular_velocity), amplitude = norm(motion.angular_amplitude);
    rotates_ = rate * range.full_speed_time > 0;
    swings_ = amplitude * (range.swing_high - range.swing_low) > 0;
    turning_ = rotates_  ? Turning{centre_, motion.angular_velocity / rate, 0, rate * range.full_speed_time}
               : swings_ ? Turning{centre_, motion.angular_amplitude / amplitude, amplitude * range.swing_low,
                                   amplitude * range.swing_high}
                         : Turning{};
  }

  bool turns() const { return rotates_ || swings_; }

  Extent operator()(const Vec3& point, int axis) const {
    if (!turns()) return {component(point, axis), component(point, axis)};
    if (!(rotates_ && swings_)) return turning_.arc(point, axis);
    const Real reach = norm(point - centre_);
    return {component(centre_, axis) - reach, component(centre_, axis) + reach};
  }

 private:
  Vec3 centre_;
  bool rotates_ = false, swings_ = false;
  Turning turning_;
};

Extent widened(const Extent& extent, Real by) { return {extent.low - by, extent.high + by}; }

/// `path(point, axis)`: where a point of the wall gets to.
template <class Path>
Extent extent_of(const Bounds& bounds, int axis, const Path& path) {
  Extent extent = kNothing;
  for (const auto& ball : bounds.balls) include(extent, widened(path(ball.centre, axis), ball.radius));
  for (const Rim& rim : bounds.rims) {
    if (!path.turns()) {
      const Real n = component(rim.normal, axis);
      include(extent, widened(path(rim.centre, axis), rim.radius * std::sqrt(std::max(1 - n * n, Real(0)))));
      continue;
    }
    const Vec3 side = any_perpendicular(rim.normal), other = cross(rim.normal, side);
    const Real radius = rim.radius / std::cos(kPi / kRimCorners);
    for (int corner = 0; corner < kRimCorners; ++corner) {
      const Real angle = 2 * kPi * corner / kRimCorners;
      include(extent, path(rim.centre + radius * (std::cos(angle) * side + std::sin(angle) * other), axis));
    }
  }
  return extent;
}

}  // namespace

Extent extent_at_start(const Wall& wall, int axis) {
  return extent_of(bounds_of(wall), axis, TurningPath(Motion{}, 0));
}

Extent shift_range(const Motion& motion, int axis, Real until) {
  const MotionRange range = motion_range(motion, until);
  // In a run without an end the time is infinite.
  const Real velocity = component(motion.velocity, axis), amplitude = component(motion.amplitude, axis);
  const Real drift = velocity != 0 ? velocity * range.full_speed_time : 0;
  const Real low = amplitude * range.swing_low, high = amplitude * range.swing_high;
  return {std::min(drift, Real(0)) + std::min(low, high), std::max(drift, Real(0)) + std::max(low, high)};
}

Extent swept_extent(const Wall& wall, int axis, Real until) {
  const Extent turned = extent_of(bounds_of(wall), axis, TurningPath(wall.motion, until));
  const Extent shift = shift_range(wall.motion, axis, until);
  return {turned.low + shift.low, turned.high + shift.high};
}

}  // namespace dem_gpu
