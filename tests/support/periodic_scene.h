// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tests/support/dem_scenes.h"

namespace test_support {

/// Periodic along the axes named in `axes` ("xz"), from low to low + length.
inline dem_gpu::PeriodicBox periodic_box(const Vec3& low, const Vec3& length, const std::string& axes = "xyz") {
  dem_gpu::PeriodicBox box;
  const Real lows[3] = {low.x, low.y, low.z}, lengths[3] = {length.x, length.y, length.z};
  for (const char axis : axes) {
    const auto i = static_cast<std::size_t>(axis - 'x');
    box.span[i] = dem_gpu::PeriodicSpan{lows[i], lows[i] + lengths[i]};
  }
  return box;
}

/// x in the box, or the same place one box length on.
inline Vec3 in_box(const dem_gpu::PeriodicBox& box, Vec3 x) {
  Real* coordinates[3] = {&x.x, &x.y, &x.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const auto& span = box.span[axis]) {
      Real& at = *coordinates[axis];
      at -= std::floor((at - span->low) / (span->high - span->low)) * (span->high - span->low);
      if (at >= span->high) at = span->low;
    }
  return x;
}

inline bool is_in_box(const dem_gpu::PeriodicBox& box, const Vec3& x) { return in_box(box, x) == x; }

/// The shortest way from a to b.
inline Vec3 nearest_offset(const dem_gpu::PeriodicBox& box, const Vec3& a, const Vec3& b) {
  Vec3 offset = b - a;
  Real* coordinates[3] = {&offset.x, &offset.y, &offset.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const auto& span = box.span[axis]) {
      const Real length = span->high - span->low;
      *coordinates[axis] -= std::round(*coordinates[axis] / length) * length;
    }
  return offset;
}

/// Cubes of two parts, rocks and balls, with friction and rolling resistance, run and tumble down a rough incline: a
/// floor with fixed rocks on it, periodic along x and y. One body is thrown up and leaves.
inline dem_gpu::Scene periodic_incline() {
  dem_gpu::Scene scene = empty_scene(0.5, 0.4);
  scene.gravity = {4.2, 0.9, -8.8};
  scene.contact[0][0].rolling_friction = 0.05;
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.sphere_law = dem_gpu::LinearSpring{2e4};
  std::mt19937 random(78);
  scene.shapes = {box_shape({0.02, 0.02, 0.02}, {2, 1, 1}),
                  dem_gpu::polyhedral_shape("rock", {random_convex_part(random, 20, {0.012, 0.01, 0.008})}),
                  dem_gpu::sphere_shape("ball", 0.008)};
  scene.periodic = periodic_box({-0.03, 0.01, 0}, {0.09, 0.08, 0}, "xy");
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y) {
      scene.bodies.push_back(body_at(1, {-0.029 + 0.045 * x, 0.0105 + 0.04 * y, 0.002}, random_rotation(random)));
      scene.bodies.back().is_fixed = true;
    }
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 3; ++z) {
        const Vec3 centre{-0.015 + 0.03 * x, 0.03 + 0.04 * y, 0.036 + 0.036 * z};
        scene.bodies.push_back(body_at((x + y + z) % 3, centre, random_rotation(random), {0.6, 0.5, -0.8}));
      }
  scene.bodies.back().velocity = {0.2, 0, 2.5};
  scene.walls = {floor_wall()};
  scene.outflow = dem_gpu::Outflow{{0, 0, -1}, -0.2};
  scene.run.time_step = 1e-5;
  return scene;
}

}  // namespace test_support
