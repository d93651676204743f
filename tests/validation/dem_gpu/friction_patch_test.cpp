// SPDX-License-Identifier: Apache-2.0
// Friction of polyhedra: one contact a pair of bodies, whatever its parts (contact-laws.md section 6).
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>

#include "catalog/input_error.h"
#include "tests/support/dem_runs.h"
#include "tests/support/grooved_block.h"
#include "tests/support/precision.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;
using Counts = std::array<int, 3>;

constexpr double kGravity = 9.81, kFriction = 0.5, kDegree = std::numbers::pi / 180;
constexpr double kEdge = 0.02, kMass = 2500 * kEdge * kEdge * kEdge;
/// A face landing at 1 m/s sinks in by 0.2 mm.
constexpr double kStiffness = kMass / (2 * kEdge * kEdge * 4e-8);
/// Depth at rest, and the length of the slabs [m].
constexpr double kSunk = kMass * kGravity / (2 * kStiffness * kEdge * kEdge), kSlab = 0.2;

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
                  box_shape({kSlab, kSlab, 0.04}, support.slab_parts)};
  scene.bodies = {body_at(0, {0, 0, kEdge / 2 - kSunk})};
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

TEST(Push, AddsMomentumAndRefusesBodiesThatAreNotThere) {
  Simulation simulation(cube_on(kSupports[0]));
  const double inertia = kMass * kEdge * kEdge / 6;
  const double before = simulation.ledger().initial;  // of the cube resting in its overlap
  simulation.push(0, {0, 0, 2 * kMass}, {0, 3 * inertia, 0});
  EXPECT_NEAR(simulation.snapshot().velocity[0].z, 2, 1e-12);
  EXPECT_NEAR(simulation.snapshot().angular_velocity[0].y, 3, 1e-12);
  EXPECT_NEAR(simulation.ledger().initial - before, kMass * 2 + inertia * 4.5, 1e-12) << "J";
  EXPECT_THROW(simulation.push(1, {}, {}), catalog::InputError);
  EXPECT_THROW(simulation.push(-1, {}, {}), catalog::InputError);
}

TEST(Rocking, DoesNotRatchet) {
  // An aggregated point with a spring in proportion to the load crept by 0.036 and 0.38 mm, part pairs by up to 25 mm.
  const double shares[] = {0.2, 0.3}, reached[] = {0.036e-3, 0.38e-3};
  for (int i = 0; i < 2; ++i) {
    double first = 0;
    for (const Support& support : kSupports) {
      Simulation simulation(cube_on(support));
      const Vec3 force = weight(0.5 * kFriction);
      run_loaded(simulation, 0.2, [&](double) { return Load{force, {}}; });
      const double start = simulation.snapshot().position[0].x;
      run_loaded(simulation, 3.2, [&](double time) {
        const double couple = shares[i] * kMass * kGravity * kEdge * std::sin(2 * std::numbers::pi * 11 * (time - 0.2));
        return Load{force, {0, couple, 0}};
      });
      const double creep = simulation.snapshot().position[0].x - start;
      std::printf("  rocking %.1f m g L at 11 Hz for 3 s on %s: creep %.7f mm\n", shares[i], support.name, 1e3 * creep);
      EXPECT_LT(std::abs(creep), reached[i]);
      // The cut does not count. A slab has a field of the cube in its rim that a plane has not: 0.2 % of the creep.
      if (support.slab_parts == Counts{1, 1, 1} && support.cube_parts == Counts{1, 1, 1}) first = creep;
      // In mixed precision the depth is known to `position` of the slab: the load, and with it the creep.
      EXPECT_NEAR(creep, first, 1e-9 * kEdge + kSingle.position * (kEdge + kSlab / kSunk * std::abs(first)))
          << support.name;
    }
  }
}

TEST(Yaw, HoldsBelowAndSpinsAboveItsLimit) {
  // Uniform pressure on a square: spins at 0.3826 mu N L; the patch's limit 0.93 / sqrt(6) = 0.3797 mu N L.
  for (const Support& support : kSupports)
    for (const double share : {0.05, 0.37, 0.39}) {
      Simulation simulation(cube_on(support));
      const Vec3 force = weight(0);
      const Vec3 couple{0, 0, share * kFriction * kMass * kGravity * kEdge};
      run_loaded(simulation, 0.2, [&](double) { return Load{force, {}}; });
      run_loaded(simulation, 0.5, [&](double time) { return Load{force, std::min(1.0, (time - 0.2) / 0.1) * couple}; });
      const double early = yaw(simulation.snapshot().orientation[0]);
      run_loaded(simulation, 0.7, [&](double) { return Load{force, couple}; });
      const double late = yaw(simulation.snapshot().orientation[0]);
      std::printf("  yaw %.2f mu m g L on %s: %.3e rad, %.2e rad/s\n", share, support.name, late, (late - early) / 0.2);
      if (share < 0.38) {
        EXPECT_LT(late, 1e-4);
        EXPECT_LT(std::abs(late - early) / 0.2, 1e-8) << "rad/s";
      } else {
        EXPECT_GT(late - early, 0.1) << "rad";
      }
    }
}

/// The block astride a roof of 45 degrees whose ridge is the y axis, gravity turned by `angle` towards +y.
Scene astride_roof(int slices, double angle) {
  Scene scene = empty_scene(0.5, kFriction);
  scene.polyhedral_law = dem_gpu::DepthPotential{kStiffness};
  scene.gravity = kGravity * Vec3{0, std::sin(angle), -std::cos(angle)};
  scene.shapes = {symmetric_shape(grooved_block(slices))};
  dem_gpu::Wall roof;
  roof.name = "roof";
  roof.geometry = dem_gpu::VolumeObject{roof_part()};
  scene.walls = {roof};
  const auto& first = std::get<dem_gpu::PolyhedralShape>(scene.shapes[0].geometry).parts[0];
  const double groove_edge = first.vertices[2][2], face = 0.04 * 0.015 * std::sqrt(2.0);
  const double sunk = 2500 * scene.shapes[0].volume * kGravity * std::cos(angle) / (2 * kStiffness * face);
  scene.bodies = {body_at(0, {0, 0, -groove_edge - sunk})};
  return scene;
}

TEST(InnerCorner, SlidesAtTheSumOfItsFaces) {
  // Two faces at 45 degrees each carry m g cos / sqrt(2): the limit is sqrt(2) mu m g cos.
  const double critical = std::atan(std::sqrt(2.0) * kFriction);
  for (const int slices : {1, 2, 4})
    for (const double off : {-0.1, 0.1}) {
      const double angle = critical + off * kDegree;
      Simulation simulation(astride_roof(slices, angle));
      run_to(simulation, 0.3);
      const auto early = simulation.snapshot();
      run_to(simulation, 0.8);
      const auto late = simulation.snapshot();
      const double speed = norm(late.position[0] - early.position[0]) / 0.5;
      const double gained = late.velocity[0].y - early.velocity[0].y;
      const double expected = 0.5 * kGravity * (std::sin(angle) - std::sqrt(2.0) * kFriction * std::cos(angle));
      std::printf("  groove of %d parts, %+.1f degree: speed %.2e m/s, gained %.6f of exact\n", 2 * slices, off, speed,
                  gained / expected);
      if (off < 0)
        EXPECT_LT(speed, 1e-8) << "m/s";
      else
        EXPECT_NEAR(gained / expected, 1, 0.05);  // 5 % of 0.1 degree
    }
}

/// A heavy slab of 0.2 x 0.2 x 0.04 m in the shape of an L in plan, cut from its inner corner.
dem_gpu::Shape ell_slab(int cut) {
  const std::array<std::vector<Real>, 3> cuts{{{-0.1, 0, 0.1}, {-0.1, 0, 0.1}, {-0.02, 0.02}}};
  auto parts = grid_parts({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, cuts);
  if (cut == 1) {  // one long part and a short one
    auto long_part = grid_parts({{0, 0, 0}}, {{{-0.1, 0.1}, {-0.1, 0}, {-0.02, 0.02}}})[0];
    parts = {long_part, parts[2]};
    parts[1].faces[2].kind = catalog::FaceKind::inner;
  }
  return {"ell", dem_gpu::PolyhedralShape{parts}, 0.0012, {1e-5, 1e-5, 1e-5}};
}

TEST(Dragged, SlidesOverSeamsAtConstantForce) {
  // 0.3 m/s over the seams of slabs and of an L cut in two ways, a pull holding the balance with friction.
  for (int slab = 0; slab < 6; ++slab) {
    Scene scene = cube_on(kSupports[slab < 5 ? slab : 4]);
    if (slab >= 4) scene.shapes[1] = ell_slab(slab - 4);
    scene.bodies[0].position.x = -0.06;
    scene.bodies[0].position.y = slab >= 4 ? -0.05 : 0.003;
    Simulation simulation(scene);
    const Vec3 force = weight(0);
    run_loaded(simulation, 0.2, [&](double) { return Load{force, {}}; });
    simulation.push(0, {0.3 * kMass, 0, 0}, {});
    const double limit = kFriction * kMass * kGravity;
    const auto drag = [&](double time) {
      run_loaded(simulation, time, [&](double) { return Load{force + Vec3{limit, 0, 0}, {}}; });
    };
    drag(0.3);  // until the cube's pitching has died out
    double least = 1e9, most = 0;
    for (int i = 0; i < 200; ++i) {
      drag(0.3 + 1e-3 * (i + 1));
      const Vec3 contact = simulation.snapshot().contacts[0].force;
      const double ratio = std::hypot(contact.x, contact.y) / (kFriction * contact.z);
      least = std::min(least, ratio), most = std::max(most, ratio);
    }
    const double x = simulation.snapshot().position[0].x;
    std::printf("  dragged on support %d to x = %.3f m: friction over mu N %.9f .. %.9f\n", slab, x, least, most);
    EXPECT_GT(x, 0.02) << "past the seam";
    EXPECT_LT(most - least, 1e-6 + kSingle.integral);
    EXPECT_NEAR(least, 1, 1e-4);  // the cube pitches by 1e-4 rad, and friction with it
  }
}

TEST(Incline, SticksForAMinute) {
  for (const bool on_slab : {false, true}) {
    Scene scene = cube_on(kSupports[0]);
    const double angle = std::atan(0.98 * kFriction);
    scene.gravity = kGravity * Vec3{std::sin(angle), 0, -std::cos(angle)};
    scene.polyhedral_law = dem_gpu::DepthPotential{kStiffness / 10};
    scene.bodies[0].position.z = kEdge / 2 - 10 * kMass * kGravity * std::cos(angle) / (2 * kStiffness * kEdge * kEdge);
    if (on_slab) scene.walls = {slab_wall()};
    Simulation simulation(scene);
    run_to(simulation, 1);
    const auto early = simulation.snapshot();
    run_to(simulation, 61);
    const auto late = simulation.snapshot();
    const double creep = norm(late.position[0] - early.position[0]) / 60;
    std::printf("  tan = 0.98 mu on %s: creep %.1e m/s over 60 s\n", on_slab ? "slab" : "plane", creep);
    EXPECT_LT(creep, 1e-8);
  }
}

TEST(Incline, TallBlockTopplesBeforeItSlides) {
  // 20 x 20 x 60 mm: topples from tan = 1/3, below mu = 1/2. The contact is soft, so it
  // gives way a little before: the edge that carries the load lies inside, and the block leans.
  for (const double share : {0.96, 1.03}) {
    Scene scene = cube_on(kSupports[0]);
    scene.shapes[0] = box_shape({kEdge, kEdge, 3 * kEdge});
    scene.polyhedral_law = dem_gpu::DepthPotential{100 * kStiffness};
    const double mass = 3 * kMass;
    scene.bodies[0].position.z = 1.5 * kEdge - mass * kGravity / (200 * kStiffness * kEdge * kEdge);
    Simulation simulation(scene);
    const auto load = [&](double time) {
      const double angle = std::atan(std::min(1.0, time / 0.3) * share / 3);
      return Load{mass * kGravity * Vec3{std::sin(angle), 0, -std::cos(angle)}, {}};
    };
    run_loaded(simulation, 0.8, load);
    const auto end = simulation.snapshot();
    const double tilt = 2 * std::acos(std::min(1.0, std::abs(double(end.orientation[0].w)))) / kDegree;
    std::printf("  tall block at %.2f of its toppling slope: tilt %.3f degrees, x %.2e m\n", share, tilt,
                end.position[0].x);
    if (share < 1) {
      EXPECT_LT(tilt, 1);
    } else {
      EXPECT_GT(tilt, 10);
    }
  }
}

TEST(LeaningStack, StandsBelowTheGreatestOverhangAndFallsAbove) {
  // n = 3 equal blocks over the edge of a table: 0.9167 L (benchmarks.md section 6); the soft contact takes some.
  for (const double share : {0.95, 1.03}) {
    Scene scene = empty_scene(0.2, kFriction);
    scene.polyhedral_law = dem_gpu::DepthPotential{10 * kStiffness};
    scene.gravity = {0, 0, -kGravity};
    scene.shapes = {box_shape({kEdge, kEdge, kEdge / 2}), box_shape({0.1, 0.1, 0.02})};
    dem_gpu::Wall table;
    table.name = "table";
    table.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.1, 0.1, 0.02}), {}, {-0.05, 0, -0.01})};
    scene.walls = {table};
    double x = -kEdge / 2;
    std::vector<double> reach;
    for (int n = 3; n >= 1; --n) reach.push_back(x += share * kEdge / 2 / n);
    for (int block = 0; block < 3; ++block)
      scene.bodies.push_back(body_at(0, {reach[static_cast<std::size_t>(block)], 0, kEdge / 4 + block * kEdge / 2}));
    Simulation simulation(scene);
    run_to(simulation, 1);
    const auto end = simulation.snapshot();
    const double fallen = 1.25 * kEdge - end.position[2].z;
    std::printf("  stack of 3 at %.2f of the greatest overhang: top has come down by %.2e m\n", share, fallen);
    if (share < 1) {
      EXPECT_LT(fallen, 0.05 * kEdge);
    } else {
      EXPECT_GT(fallen, 0.25 * kEdge);
    }
  }
}

TEST(Friction, OnlyDissipatesInImpactsOfAllKinds) {
  // Shear losses of every step, and kinetic energy after elastic impacts: corners, edges and faces, spinning, grazing.
  double largest_return = 0, largest_gain = 0;
  std::mt19937 random(5);
  for (int i = 0; i < 40; ++i) {
    Scene scene = empty_scene(1, 0.4);
    scene.shapes = {box_shape({0.02, 0.02, 0.02}, {1 + i % 2, 1, 1})};
    scene.walls = {i % 4 < 2 ? floor_wall() : slab_wall()};
    const double angle = (2 + 2.1 * i) * kDegree;
    const Quaternion tilt = i % 5 == 0 ? Quaternion{} : i % 5 == 1 ? edge_down() : random_rotation(random);
    scene.bodies = {body_at(0, {0, 0, 0.018}, tilt, {std::sin(angle), 0, -std::cos(angle)})};
    scene.bodies[0].angular_velocity = 60 * random_direction(random);
    scene.run.steps_per_contact = 100;
    Simulation simulation(scene);
    double lost = 0;
    int touching = 0;
    for (int step = 0; step < 400000; ++step) {
      simulation.advance(1);
      const bool is_touching = !simulation.snapshot().contacts.empty();
      touching += is_touching;
      const auto ledger = simulation.ledger();
      const double now = ledger.dissipation[1].shear;
      largest_return = std::max(largest_return, (lost - now) / ledger.initial);
      lost = std::max(lost, now);
      if (touching > 0 && !is_touching) break;
    }
    const auto ledger = simulation.ledger();
    largest_gain = std::max(largest_gain, ledger.kinetic / ledger.initial - 1);
  }
  std::printf("  40 elastic impacts: friction returned at most %.1e of the energy, kinetic energy gained %.1e\n",
              largest_return, largest_gain);
  // The trapezoidal rule's error while patch and lever change within a step; it falls with the step.
  EXPECT_LT(largest_return, 1e-5);
  EXPECT_LT(largest_gain, 1e-4);
}

/// A cube in the slot of a fixed body, 2 x 10 um narrower than it: each side presses with N.
struct Slot {
  static constexpr double kSunk = 1e-5, kPress = 2 * kStiffness * kEdge * kEdge * kSunk;

  /// `off`: of the cube from the middle [m]. `pull`: along the slot, over 2 mu N.
  static Scene scene(double off, double pull) {
    Scene scene = empty_scene(0.5, kFriction);
    scene.polyhedral_law = dem_gpu::DepthPotential{kStiffness};
    constexpr Real w = kEdge / 2 - kSunk;
    // The two sides stand on a bottom, out of the cube's reach.
    const auto parts = grid_parts({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {2, 0, 1}},
                                  {std::vector<Real>{-w - kEdge, -w, w, w + kEdge}, std::vector<Real>{-0.04, 0.04},
                                   std::vector<Real>{-0.04, -0.02, 0.02}});
    scene.shapes = {box_shape({kEdge, kEdge, kEdge}),
                    {"slot", dem_gpu::PolyhedralShape{parts}, 1e-4, {1e-8, 1e-8, 1e-8}}};
    scene.bodies = {body_at(0, {off, 0, 0}), body_at(1, {})};
    scene.bodies[1].is_fixed = true;
    scene.gravity = {0, pull * 2 * kFriction * kPress / kMass, 0};
    return scene;
  }
};

TEST(Slot, CarriesTheFrictionOfBothSidesWhereTheirForcesCancel) {
  for (const double off : {0.0, 1e-18, 1e-9, 1e-6}) {
    const double time = 0.01, slack = 1e-4;
    Simulation held(Slot::scene(off, 0.8)), sliding(Slot::scene(off, 1.25));
    run_to(held, time);
    run_to(sliding, time);
    const double moved = held.snapshot().position[0].y;
    const double speed = sliding.snapshot().velocity[0].y;
    const double expected = 0.25 / 1.25 * norm(Slot::scene(off, 1.25).gravity) * time;
    std::printf("  slot, %.0e m off the middle: at 0.8 of 2 mu N moves %.1e m, at 1.25 slides at %.4f m/s (%.4f)\n",
                off, moved, speed, expected);
    EXPECT_LT(std::abs(moved), slack) << "the friction springs give way";
    // What the springs take before they slip: half their length's worth of motion.
    EXPECT_NEAR(speed / expected, 1, 0.1);
  }
}

}  // namespace
