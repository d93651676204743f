// SPDX-License-Identifier: Apache-2.0
// Torque-free tops. References: elliptic functions (van Zon & Schofield 2007), evaluated to 14 digits.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

/// The engine's shapes have ascending moments of inertia, the references descending ones: the body is built with its
/// axes turned by this (new x, y, z are old z, y, -x), so that the splitting goes about the same axes as for any shape.
const Quaternion kAxes = dem_gpu::axis_angle({0, 1, 0}, -std::numbers::pi / 2);

/// `reference_half`, `spin`: in the reference's axes.
Scene top(const Vec3& reference_half, const Vec3& spin, Real time_step) {
  const Vec3 half{reference_half.z, reference_half.y, reference_half.x};
  Scene scene = empty_scene(1, 0);
  scene.shapes = {box_shape(2 * half)};
  scene.materials[0].density = 1 / scene.shapes[0].volume;
  scene.polyhedral_law = dem_gpu::DepthPotential{0.01};  // no contacts: any step is short enough
  scene.bodies = {body_at(0, {}, kAxes)};
  scene.bodies[0].angular_velocity = spin;
  scene.run.time_step = time_step;
  return scene;
}

/// [kg m2], in the reference's axes.
Vec3 reference_inertia(const Scene& scene) {
  const Vec3 inertia = scene.materials[0].density * scene.shapes[0].principal_inertia;
  return {inertia.z, inertia.y, inertia.x};
}

struct TopError {
  double orientation = 0;  // [rad]
  double energy = 0;       // relative
  double momentum = 0;     // relative, vector in the world frame
};

TopError error_after(const Vec3& half, const Vec3& spin, double time, const Quaternion& expected, double time_step) {
  const Scene scene = top(half, spin, time_step);
  Simulation simulation(scene);
  run_to(simulation, time);
  const auto end = simulation.snapshot();
  const Quaternion q = end.orientation[0] * conjugate(kAxes);
  const Quaternion turn = conjugate(expected) * q;
  const Vec3 inertia = reference_inertia(scene);
  const Vec3 body_spin = rotate_back(q, end.angular_velocity[0]);
  const double before = dot(inertia, hadamard(spin, spin)), after = dot(inertia, hadamard(body_spin, body_spin));
  const Vec3 momentum = hadamard(inertia, spin);
  return {2 * std::asin(std::min(1.0, norm(Vec3{turn.x, turn.y, turn.z}))), std::abs(after / before - 1),
          norm(rotate(q, hadamard(inertia, body_spin)) - momentum) / norm(momentum)};
}

const Vec3 kBox{0.1, 0.2, 0.3};
const Quaternion kEnd1{-0.36486374298686, 0.023563357342589, 0.021262001052007, -0.93051982491273};
const Quaternion kEnd2{0.5181248230281, -0.0087369517343492, -0.85525049327741, -0.0041142660642137};

TEST(TorqueFreeTop, R1GeneralSpin) {
  const TopError coarse = error_after(kBox, {1, 2, 3}, 5, kEnd1, 0.01),
                 fine = error_after(kBox, {1, 2, 3}, 5, kEnd1, 0.005);
  std::printf("  R1: dt 0.01 orientation %.2e rad, energy %.2e; dt 0.005 %.2e, %.2e\n", coarse.orientation,
              coarse.energy, fine.orientation, fine.energy);
  // Row of a symmetric splitting about the body axes (two figures are given there).
  EXPECT_LT(coarse.orientation, 4.35e-5);
  EXPECT_LT(coarse.energy, 3.35e-6);
  EXPECT_NEAR(coarse.orientation / fine.orientation, 4, 0.6) << "second order";
  EXPECT_LT(coarse.momentum, 1e-12);
}

TEST(TorqueFreeTop, R2NearTheIntermediateAxis) {
  const TopError coarse = error_after(kBox, {0.05, 5, 0.05}, 10, kEnd2, 0.005),
                 fine = error_after(kBox, {0.05, 5, 0.05}, 10, kEnd2, 0.0025);
  std::printf("  R2: dt 0.005 orientation %.2e rad, energy %.2e; dt 0.0025 %.2e\n", coarse.orientation, coarse.energy,
              fine.orientation);
  EXPECT_LT(fine.orientation, coarse.orientation / 3);
  EXPECT_LT(fine.orientation, 2e-6);
  EXPECT_LT(coarse.momentum, 1e-12);
}

TEST(TorqueFreeTop, R3SymmetricPrecession) {
  // The axis turns about the angular momentum at |L| / I_perpendicular, at a constant angle.
  const Vec3 half{0.05, 0.05, 0.2}, spin{1, 0, 10};
  const Scene scene = top(half, spin, 0.005);
  Simulation simulation(scene);
  const Vec3 inertia = reference_inertia(scene);
  const Vec3 momentum = hadamard(inertia, spin), direction = momentum / norm(momentum);
  const double rate = norm(momentum) / inertia.x, time = 4;
  EXPECT_NEAR(rate, 1.54404761746, 1e-9);
  run_to(simulation, time);
  const Vec3 axis = rotate(simulation.snapshot().orientation[0] * conjugate(kAxes), {0, 0, 1});
  EXPECT_NEAR(std::acos(dot(axis, direction)) * 180 / std::numbers::pi, 40.36453657, 1e-3);
  const Vec3 expected = rotate(dem_gpu::axis_angle(direction, rate * time), {0, 0, 1});
  std::printf("  R3: axis off by %.2e rad after %.0f s\n", norm(axis - expected), time);
  EXPECT_LT(norm(axis - expected), 1e-5);
}

TEST(TorqueFreeTop, NoEnergyTrendOver100Seconds) {
  const Scene scene = top(kBox, {1, 2, 3}, 0.005);
  Simulation simulation(scene);
  double first_half = 0, second_half = 0;
  for (int i = 0; i < 200; ++i) {
    simulation.advance(100);
    const double error = simulation.ledger().kinetic / simulation.ledger().initial - 1;
    EXPECT_LT(std::abs(error), 5e-6);
    (i < 100 ? first_half : second_half) += error / 100;
  }
  std::printf("  energy of R1 over 100 s: mean error %.1e, then %.1e\n", first_half, second_half);
  EXPECT_LT(std::abs(first_half - second_half), 1e-6);
  const auto end = simulation.snapshot();
  const Vec3 inertia = reference_inertia(scene);
  const Quaternion q = end.orientation[0] * conjugate(kAxes);
  const Vec3 momentum = rotate(q, hadamard(inertia, rotate_back(q, end.angular_velocity[0])));
  EXPECT_LT(norm(momentum - hadamard(inertia, Vec3{1, 2, 3})), 1e-10 * norm(momentum));
}

}  // namespace
