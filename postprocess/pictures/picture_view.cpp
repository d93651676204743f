// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "postprocess/contact_statistics.h"
#include "postprocess/pictures.h"
#include "postprocess/pictures/machine.h"

namespace postprocess {

using dem_gpu::Vec3;
using dem_gpu::WallGeometry;
using dem_gpu::WallKind;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A little to the side and above: enough to see depth, little enough to read the charge's profile [degrees].
constexpr double kDrumAzimuth = 9, kDrumElevation = 5;
constexpr double kSideAzimuth = 22, kSideElevation = 11;

// Share of the picture's half width that the scene may take; the colour scale stands in the rest.
constexpr double kUsableWidth = 0.80;
constexpr double kUsableHeight = 0.95;

/// Unit vector across `up`, the same for all scenes that have none of their own.
Vec3 canonical_side(const Vec3& up) {
  const Vec3 trial = std::abs(up.y) < 0.9 ? Vec3{0, -1, 0} : Vec3{0, 0, 1};
  return dem_gpu::unit_or(trial - dot(trial, up) * up, any_perpendicular(up));
}

/// Direction from the scene to the eye.
Vec3 eye_direction(const Machine& machine, const Vec3& up) {
  const bool is_drum = machine.kind == SceneKind::drum;
  Vec3 side = canonical_side(up);
  if (is_drum) {
    side = dem_gpu::unit_or(machine.axis - dot(machine.axis, up) * up, side);
    if (dot(side, canonical_side(up)) < -1e-9) side = -side;
  }
  const double azimuth = (is_drum ? kDrumAzimuth : kSideAzimuth) * kDegree;
  const double elevation = (is_drum ? kDrumElevation : kSideElevation) * kDegree;
  const Vec3 turned = std::cos(azimuth) * side + std::sin(azimuth) * cross(up, side);
  return std::cos(elevation) * turned + std::sin(elevation) * up;
}

/// Points that the picture must hold: finite walls, and bodies by boxes about them.
std::vector<Vec3> scene_points(const dem_gpu::RunGeometry& geometry, const std::vector<dem_gpu::Snapshot>& snapshots) {
  std::vector<Vec3> points;
  std::vector<double> radius;
  for (const dem_gpu::ShapeGeometry& shape : geometry.shapes) radius.push_back(bounding_radius(shape));
  for (const dem_gpu::Snapshot& snapshot : snapshots) {
    for (std::size_t b = 0; b < geometry.body_shape.size(); ++b) {
      if (!snapshot.active[b]) continue;
      const double r = radius[geometry.body_shape[b]] * geometry.body_scale[b];
      for (const double sign : {-r, r})
        for (const Vec3& offset : {Vec3{sign, 0, 0}, Vec3{0, sign, 0}, Vec3{0, 0, sign}})
          points.push_back(snapshot.position[b] + offset);
    }
    for (std::size_t w = 0; w < geometry.walls.size(); ++w) {
      if (geometry.walls[w].kind == WallKind::plane || !snapshot.wall_present[w]) continue;
      Surface wall;
      append(wall, wall_surface(geometry.walls[w], {}, 48), wall_placement(snapshot, static_cast<int>(w)));
      points.insert(points.end(), wall.points.begin(), wall.points.end());
    }
  }
  if (points.empty()) points = {{-1, -1, -1}, {1, 1, 1}};
  return points;
}

/// The colour scale ends where all but the fastest 2 % of the bodies lie, so that one flier does not grey out the rest.
double speed_scale(const std::vector<dem_gpu::Snapshot>& snapshots) {
  std::vector<double> speeds;
  for (const dem_gpu::Snapshot& snapshot : snapshots)
    for (std::size_t b = 0; b < snapshot.velocity.size(); ++b)
      if (snapshot.active[b]) speeds.push_back(norm(snapshot.velocity[b]));
  if (speeds.empty()) return 1;
  const std::size_t place = (speeds.size() - 1) * 98 / 100;
  std::nth_element(speeds.begin(), speeds.begin() + static_cast<std::ptrdiff_t>(place), speeds.end());
  const double fastest = speeds[place];
  if (fastest <= 0) return 1;
  // A round number whose quarters are short as well, for the scale's labels.
  const double power = std::pow(10, std::floor(std::log10(fastest)));
  for (const double round : {1.0, 1.2, 1.6, 2.0, 2.4, 3.2, 4.0, 6.0, 8.0})
    if (fastest <= round * power * (1 + 1e-9)) return round * power;
  return 10 * power;
}

}  // namespace

Machine machine_of(const std::vector<WallGeometry>& walls, const Vec3& up) {
  Machine machine;
  for (const WallGeometry& wall : walls) {
    if (wall.kind != WallKind::cylinder && wall.kind != WallKind::cone) continue;
    const double radius = std::max(wall.base_radius, wall.top_radius);
    if (radius <= machine.radius) continue;
    const bool lies_across = std::abs(dot(wall.direction, up)) < 0.5;
    machine = {lies_across ? SceneKind::drum : SceneKind::hopper, wall.point, wall.direction, radius};
  }
  return machine;
}

WallGeometry as_drawn(const WallGeometry& wall, const Machine& machine) {
  WallGeometry drawn = wall;
  if (wall.kind != WallKind::plane || machine.kind != SceneKind::drum) return drawn;
  if (std::abs(dot(wall.direction, machine.axis)) < 0.99) return drawn;
  drawn.kind = WallKind::disc;
  drawn.base_radius = machine.radius;
  drawn.point = machine.point + dot(wall.point - machine.point, machine.axis) * machine.axis;
  return drawn;
}

PictureView picture_view(const dem_gpu::RunGeometry& geometry, const std::vector<dem_gpu::Snapshot>& snapshots,
                         const Vec3& up, const PictureSize& size) {
  for (const dem_gpu::Snapshot& snapshot : snapshots) check_same_run(geometry, snapshot);
  const Machine machine = machine_of(geometry.walls, up);
  PictureView view;
  view.kind = machine.kind;
  view.fastest = speed_scale(snapshots);
  const Vec3 backward = eye_direction(machine, up);
  const Vec3 right = dem_gpu::unit_or(cross(up, backward), any_perpendicular(backward));
  view.up = cross(backward, right);

  // Move the focus until the projected scene is centred, at the distance at which its widest point just fits.
  const std::vector<Vec3> points = scene_points(geometry, snapshots);
  Bounds bounds;
  for (const Vec3& point : points) bounds.include(point);
  const double tan_y = kUsableHeight * std::tan(view.view_angle / 2 * kDegree);
  const double tan_x = kUsableWidth * std::tan(view.view_angle / 2 * kDegree) * size.width / size.height;
  view.focus = bounds.middle();
  double distance = bounds.diagonal();
  for (int pass = 0; pass < 8; ++pass) {
    distance = 0;
    for (const Vec3& point : points) {
      const Vec3 p = point - view.focus;
      distance = std::max(
          distance, dot(p, backward) + std::max(std::abs(dot(p, right)) / tan_x, std::abs(dot(p, view.up)) / tan_y));
    }
    double left = 1e300, rightmost = -1e300, bottom = 1e300, top = -1e300;
    for (const Vec3& point : points) {
      const Vec3 p = point - view.focus;
      const double depth = distance - dot(p, backward);
      left = std::min(left, dot(p, right) / depth);
      rightmost = std::max(rightmost, dot(p, right) / depth);
      bottom = std::min(bottom, dot(p, view.up) / depth);
      top = std::max(top, dot(p, view.up) / depth);
    }
    view.focus += distance / 2 * ((left + rightmost) * right + (bottom + top) * view.up);
  }
  view.eye = view.focus + distance * backward;
  return view;
}

}  // namespace postprocess
