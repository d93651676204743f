// SPDX-License-Identifier: Apache-2.0
// Friction of polyhedra: one contact a pair of bodies, whatever its parts (contact-laws.md section 6).
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>

#include "catalog/mass_properties.h"
#include "catalog/triangle_mesh.h"
#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;
using Counts = std::array<int, 3>;

constexpr double kGravity = 9.81, kFriction = 0.5, kDegree = std::numbers::pi / 180;
constexpr double kEdge = 0.02, kMass = 2500 * kEdge * kEdge * kEdge;
/// A face landing at 1 m/s sinks in by 0.2 mm.
constexpr double kStiffness = kMass / (2 * kEdge * kEdge * 4e-8);

/// What a cube stands on: a plane, or a body cut into parts and so heavy that it stays where it is.
struct Support {
  const char* name;
  bool is_plane;
  Counts slab_parts, cube_parts;
};
const Support kSupports[] = {
    {"plane", true, {1, 1, 1}, {1, 1, 1}},      {"plane, cube of 8", true, {1, 1, 1}, {2, 2, 2}},
    {"slab of 1", false, {1, 1, 1}, {1, 1, 1}}, {"slab of 2", false, {2, 1, 1}, {1, 1, 1}},
    {"slab of 8", false, {2, 2, 2}, {1, 1, 1}}, {"slab of 8, cube of 4", false, {2, 2, 2}, {2, 2, 1}}};

Scene cube_on(const Support& support) {
  Scene scene = empty_scene(0.5, kFriction);
  scene.materials.push_back({"heavy", 2500e9});
  scene.contact.assign(2, {{0.5, kFriction}, {0.5, kFriction}});
  scene.polyhedral_law = dem_gpu::DepthPotential{kStiffness};
  scene.shapes = {box_shape({kEdge, kEdge, kEdge}, support.cube_parts),
                  box_shape({0.2, 0.2, 0.04}, support.slab_parts)};
  const Real sunk = kMass * kGravity / (2 * kStiffness * kEdge * kEdge);
  scene.bodies = {body_at(0, {0, 0, kEdge / 2 - sunk})};
  if (support.is_plane) {
    scene.walls = {floor_wall()};
  } else {
    scene.bodies.push_back(body_at(1, {0, 0, -0.02}));
    scene.bodies[1].material = 1;
  }
  return scene;
}

/// Force through the centre of body 0 [N] and couple [N m] on it.
struct Load {
  Vec3 force, couple;
};

/// Runs to `time` under a load on body 0.
void run_loaded(Simulation& simulation, double time, const std::function<Load(double)>& load) {
  const double step = simulation.time_step();
  const auto steps = std::llround((time - simulation.time()) / step);
  for (std::int64_t i = 0; i < steps; ++i) {
    const Load now = load(simulation.time());
    simulation.push(0, step * now.force, step * now.couple);
    simulation.advance(1);
  }
}

/// Weight on a slope down towards +x.
Vec3 weight(double slope) {
  const double angle = std::atan(slope);
  return kMass * kGravity * Vec3{std::sin(angle), 0, -std::cos(angle)};
}

double yaw(const Quaternion& q) { return 2 * std::atan2(q.z, q.w); }

TEST(Rocking, DoesNotRatchet) {
  for (const double share : {0.2, 0.3}) {
    double first = 0;
    for (const Support& support : kSupports) {
      Simulation simulation(cube_on(support));
      const Vec3 force = weight(0.5 * kFriction);
      run_loaded(simulation, 0.2, [&](double) { return Load{force, {}}; });
      const double start = simulation.snapshot().position[0].x;
      run_loaded(simulation, 3.2, [&](double time) {
        const double couple = share * kMass * kGravity * kEdge * std::sin(2 * std::numbers::pi * 11 * (time - 0.2));
        return Load{force, {0, couple, 0}};
      });
      const double creep = simulation.snapshot().position[0].x - start;
      std::printf("  rocking %.1f m g L at 11 Hz for 3 s on %s: creep %.4f mm\n", share, support.name, 1e3 * creep);
      if (&support == kSupports) first = creep;
    }
    (void)first;
  }
}

TEST(Yaw, HoldsBelowAndSpinsAboveItsLimit) {
  for (const Support& support : kSupports)
    for (const double share : {0.05, 0.37, 0.39}) {
      Simulation simulation(cube_on(support));
      const Vec3 force = weight(0);
      const Vec3 couple{0, 0, share * kFriction * kMass * kGravity * kEdge};
      run_loaded(simulation, 0.2, [&](double) { return Load{force, {}}; });
      const double ramp = 0.1;
      run_loaded(simulation, 0.5, [&](double time) {
        return Load{force, std::min(1.0, (time - 0.2) / ramp) * couple};
      });
      const double early = yaw(simulation.snapshot().orientation[0]);
      run_loaded(simulation, 1, [&](double) { return Load{force, couple}; });
      const double late = yaw(simulation.snapshot().orientation[0]);
      std::printf("  yaw %.2f mu m g L on %s: %.3e rad, %.2e rad/s\n", share, support.name, late, (late - early) / 0.5); {auto q=simulation.snapshot(); std::printf("    x %g %g z %g w %g %g v %g %g\n", q.position[0].x,q.position[0].y,q.position[0].z,q.angular_velocity[0].x,q.angular_velocity[0].y,q.velocity[0].x,q.velocity[0].y);}
    }
}

/// Block with a right-angled groove along y in its underside, cut at the groove's edge and `slices` times along it.
std::vector<catalog::ConvexPart> grooved_block(int slices) {
  const double width = 0.02, groove = 0.015, height = 0.03, length = 0.04;
  std::vector<catalog::ConvexPart> parts;
  for (const double side : {-1.0, 1.0})
    for (int slice = 0; slice < slices; ++slice) {
      const double from = length * slice / slices, to = length * (slice + 1) / slices;
      const std::vector<std::array<double, 2>> outline{
          {side * width, 0}, {side * groove, 0}, {0, groove}, {0, height}, {side * width, height}};
      std::vector<Vec3> vertices;
      for (const double y : {from, to})
        for (const auto& corner : outline) vertices.push_back({corner[0], y, corner[1]});
      std::vector<std::vector<int>> loops{{0, 1, 2, 3, 4}, {9, 8, 7, 6, 5}};
      for (int k = 0; k < 5; ++k) loops.push_back({k, k + 5, (k + 1) % 5 + 5, (k + 1) % 5});
      if (side > 0)
        for (auto& loop : loops) std::reverse(loop.begin(), loop.end());
      catalog::ConvexPart part = part_of(vertices, loops);
      if (slice > 0) part.faces[0].kind = catalog::FaceKind::inner;
      if (slice + 1 < slices) part.faces[1].kind = catalog::FaceKind::inner;
      part.faces[4].kind = catalog::FaceKind::inner;  // at the groove's edge
      parts.push_back(std::move(part));
    }
  return parts;
}

/// Shape symmetric about the planes x = 0 and y = 0 of its parts' frame, which becomes its body frame but for the
/// height of the centre.
dem_gpu::Shape symmetric_shape(std::vector<catalog::ConvexPart> parts) {
  catalog::VolumeMoments moments;
  for (const auto& part : parts) moments += catalog::volume_moments(catalog::triangulated(part));
  const catalog::MassProperties mass = catalog::mass_properties(moments);
  for (auto& part : parts) part = moved_part(part, {}, {0, 0, -mass.centroid[2]});
  double inertia[3] = {0, 0, 0};
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 3; ++k)
      inertia[axis] += mass.principal_inertia[k] * mass.principal_axes[k][axis] * mass.principal_axes[k][axis];
  return {"block", dem_gpu::PolyhedralShape{parts}, mass.volume, {inertia[0], inertia[1], inertia[2]}};
}

/// The block astride a roof of 45 degrees whose ridge is the y axis, gravity turned by `angle` towards +y.
Scene astride_roof(int slices, double angle) {
  Scene scene = empty_scene(0.5, kFriction);
  scene.polyhedral_law = dem_gpu::DepthPotential{kStiffness};
  scene.gravity = kGravity * Vec3{0, std::sin(angle), -std::cos(angle)};
  scene.shapes = {symmetric_shape(grooved_block(slices))};
  dem_gpu::Wall roof;
  roof.name = "roof";
  roof.geometry = dem_gpu::VolumeObject{
      part_of({{-0.1, -0.3, -0.1}, {0.1, -0.3, -0.1}, {0, -0.3, 0}, {-0.1, 0.3, -0.1}, {0.1, 0.3, -0.1}, {0, 0.3, 0}},
              {{0, 1, 2}, {5, 4, 3}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}})};
  scene.walls = {roof};
  const auto& first = std::get<dem_gpu::PolyhedralShape>(scene.shapes[0].geometry).parts[0];
  const double groove_edge = first.vertices[2][2], face = 0.04 * 0.015 * std::sqrt(2.0);
  const double sunk = 2500 * scene.shapes[0].volume * kGravity * std::cos(angle) / (2 * kStiffness * face);
  scene.bodies = {body_at(0, {0, 0, -groove_edge - sunk})};
  return scene;
}

TEST(InnerCorner, SlidesAtTheSumOfItsFaces) {
  const double critical = std::atan(std::sqrt(2.0) * kFriction);
  for (const int slices : {1, 2, 4})
    for (const double off : {-0.1, 0.1}) {
      Simulation simulation(astride_roof(slices, critical + off * kDegree));
      run_to(simulation, 0.3);
      const auto early = simulation.snapshot();
      run_to(simulation, 0.8);
      const auto late = simulation.snapshot();
      std::printf("  groove of %d parts, %+.1f degree: speed %.2e, gained %.3e m/s in 0.5 s (%.3e)\n", 2 * slices, off,
                  norm(late.position[0] - early.position[0]) / 0.5, late.velocity[0].y - early.velocity[0].y,
                  0.5 * kGravity * off * kDegree / std::cos(critical));
    }
}

}  // namespace
