// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "catalog/input_error.h"
#include "dem_gpu/shapes/least_width.h"
#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;
using dem_gpu::least_width;
using dem_gpu::polyhedral_shape;

/// The message of the refusal, or "accepted".
std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::vector<catalog::ConvexPart>& parts, const std::string& words) {
  const std::string message = refusal([&] { polyhedral_shape("grain", parts); });
  EXPECT_NE(message.find(words), std::string::npos) << message;
  EXPECT_NE(message.find("'grain'"), std::string::npos) << "names the shape: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
}

TEST(ShapeBuilder, BoxHasItsMassProperties) {
  const auto shape = polyhedral_shape(
      "box", {moved_part(dem_gpu::box_part({0.1, 0.2, 0.3}), dem_gpu::axis_angle({0, 0.6, 0.8}, 1), {3, 4, 5})});
  const Real volume = 0.006;
  EXPECT_NEAR(shape.volume / volume, 1, 1e-10);
  // Ascending: the longest edge lies along x.
  EXPECT_NEAR(shape.principal_inertia.x / (volume * (0.01 + 0.04) / 12), 1, 1e-9);
  EXPECT_NEAR(shape.principal_inertia.y / (volume * (0.01 + 0.09) / 12), 1, 1e-9);
  EXPECT_NEAR(shape.principal_inertia.z / (volume * (0.04 + 0.09) / 12), 1, 1e-9);
  for (const catalog::Point& vertex : std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts[0].vertices) {
    EXPECT_NEAR(std::abs(vertex[0]), 0.15, 1e-12);
    EXPECT_NEAR(std::abs(vertex[1]), 0.10, 1e-12);
    EXPECT_NEAR(std::abs(vertex[2]), 0.05, 1e-12);
  }
}

/// An L of three unit cubes in two cuts.
std::vector<catalog::ConvexPart> l_shape(int cut) {
  const std::array<std::vector<Real>, 3> cuts{{{0, 1, 2}, {0, 1, 2}, {0, 1}}};
  if (cut == 3) return grid_parts({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, cuts);
  // A bar of two and a cube, the bar along x or y.
  auto bar = cut == 1 ? box_part({0, 0, 0}, {2, 1, 1}) : box_part({0, 0, 0}, {1, 2, 1});
  auto cube = cut == 1 ? box_part({0, 1, 0}, {1, 2, 1}) : box_part({1, 0, 0}, {2, 1, 1});
  cube.faces[cut == 1 ? 2 : 0].kind = catalog::FaceKind::inner;
  return {bar, cube};
}

TEST(ShapeBuilder, LShapeHasItsMassPropertiesInEveryCut) {
  // Centroid (5/6, 5/6, 1/2). In-plane second moments about it: 13/12 - ... by parallel axes of three cubes.
  const Real c = 5.0 / 6;
  const Real squares = 2 * (0.5 - c) * (0.5 - c) + (1.5 - c) * (1.5 - c);  // sum over cubes of (x - c)^2
  const Real products = (0.5 - c) * (0.5 - c) + 2 * (1.5 - c) * (0.5 - c);
  const Real xx = 3.0 / 12 + squares, xy = products, zz = 3.0 / 12;  // integrals of x x, x y, z z
  // Principal directions are the diagonals: integrals xx + xy and xx - xy.
  Real expected[3] = {xx - xy + zz, xx + xy + zz, 2 * xx};
  std::sort(expected, expected + 3);
  for (const int cut : {1, 2, 3}) {
    const auto shape = polyhedral_shape("L", l_shape(cut));
    EXPECT_NEAR(shape.volume, 3, 1e-13);
    EXPECT_NEAR(shape.principal_inertia.x, expected[0], 1e-12);
    EXPECT_NEAR(shape.principal_inertia.y, expected[1], 1e-12);
    EXPECT_NEAR(shape.principal_inertia.z, expected[2], 1e-12);
  }
}

TEST(ShapeBuilder, SphereHasItsInertia) {
  const auto shape = dem_gpu::sphere_shape("ball", 0.2);
  EXPECT_NEAR(shape.volume, 4 * std::numbers::pi / 3 * 0.008, 1e-15);
  EXPECT_NEAR(shape.principal_inertia.y, 0.4 * shape.volume * 0.04, 1e-15);
  EXPECT_NE(refusal([] { dem_gpu::sphere_shape("ball", -1); }), "accepted");
}

TEST(ShapeBuilder, RefusesWhatIsNoSolid) {
  expect_refused({}, "no parts");
  expect_refused({dem_gpu::box_part({1, 1, 1e-9})}, "flat");

  auto inverted = unit_cube();
  for (auto& face : inverted.faces) std::reverse(face.vertices.begin(), face.vertices.end());
  expect_refused({inverted}, "inside out");

  for (int missing = 0; missing < 6; ++missing) {
    auto open = unit_cube();
    open.faces.erase(open.faces.begin() + missing);
    expect_refused({open}, "open");
  }

  auto dented = unit_cube();
  dented.vertices.push_back({0.9, 0.9, 0.9});  // beyond its faces
  expect_refused({dented}, "not convex");

  auto loose = unit_cube();
  loose.faces[3].plane.offset = 0.7;  // behind all vertices, but through none
  expect_refused({loose}, "plane");

  auto dangling = unit_cube();
  dangling.faces[0].vertices[2] = 8;
  expect_refused({dangling}, "no vertex");
}

TEST(ShapeBuilder, RefusesMoreThanTheEngineHolds) {
  std::mt19937 random(1);
  expect_refused({random_convex_part(random, dem_gpu::kMaxPartVertices + 1)}, "65 vertices");
  std::vector<Vec3> ring;  // a prism whose end faces have 33 corners would have 66 vertices: a pyramid has 34
  for (int i = 0; i < 33; ++i)
    ring.push_back({std::cos(2 * std::numbers::pi * i / 33), std::sin(2 * std::numbers::pi * i / 33), 0});
  ring.push_back({0, 0, 1});
  std::vector<std::vector<int>> loops(1);
  for (int i = 32; i >= 0; --i) loops[0].push_back(i);
  for (int i = 0; i < 33; ++i) loops.push_back({i, (i + 1) % 33, 33});
  expect_refused({part_of(ring, loops)}, "33 corners");
}

TEST(ShapeBuilder, RefusesPartsThatOverlap) {
  const auto a = unit_cube(), b = moved_part(unit_cube(), {}, {0.9, 0, 0});
  expect_refused({a, b}, "overlap by 5.");  // 0.1 of 2 cubes
  EXPECT_EQ(refusal([&] { polyhedral_shape("pair", {a, moved_part(unit_cube(), {}, {1, 0, 0})}); }), "accepted");
  const Quaternion turn = dem_gpu::axis_angle({0.6, 0, 0.8}, 0.7);
  EXPECT_EQ(refusal([&] {
              polyhedral_shape("turned pair",
                               {moved_part(a, turn, {}), moved_part(moved_part(unit_cube(), {}, {1, 0, 0}), turn, {})});
            }),
            "accepted");
  expect_refused({a, a}, "overlap by 50");
}

// Scene checks: each message names the place and what is wanted.

dem_gpu::Scene good_scene() {
  dem_gpu::Scene scene = empty_scene(0.5, 0.5);
  scene.shapes = {box_shape({0.02, 0.02, 0.02}), dem_gpu::sphere_shape("ball", 0.01)};
  scene.bodies = {body_at(0, {0, 0, 1}), body_at(1, {1, 0, 1})};
  scene.walls = {floor_wall()};
  return scene;
}

TEST(SceneCheck, AcceptsAGoodScene) {
  EXPECT_EQ(refusal([] { check(good_scene()); }), "accepted");
}

TEST(SceneCheck, RefusesBadInputNamingThePlace) {
  const Real nan = std::nan("");
  struct Fault {
    std::function<void(dem_gpu::Scene&)> make;
    const char *place, *words;
  };
  using dem_gpu::Scene;
  const Fault faults[] = {
      {[](Scene& s) { s.bodies.clear(); }, "scene 'test'", "no bodies"},
      {[](Scene& s) { s.bodies[1].shape = 2; }, "body 1", "no such shape"},
      {[](Scene& s) { s.bodies[0].shape = -1; }, "body 0", "no such shape"},
      {[](Scene& s) { s.bodies[0].material = 1; }, "body 0", "no such material"},
      {[](Scene& s) { s.bodies[0].scale = 0; }, "body 0", "positive"},
      {[=](Scene& s) { s.bodies[1].position.y = nan; }, "body 1", "finite"},
      {[](Scene& s) {
         s.bodies[1].orientation = {0, 0, 0, 0};
       },
       "body 1", "orientation"},
      {[](Scene& s) { s.materials[0].density = -1; }, "material 'rock'", "density"},
      {[](Scene& s) { s.materials[0].poisson_ratio = 1.2; }, "material 'rock'", "Poisson"},
      {[](Scene& s) {
         s.materials.push_back({"steel", 7800});
       },
       "contact", "row"},
      {[](Scene& s) { s.contact[0][0].restitution = 0; }, "contact of 'rock' with 'rock'", "restitution"},
      {[](Scene& s) { s.contact[0][0].restitution = -0.5; }, "contact of 'rock' with 'rock'", "restitution"},
      {[](Scene& s) { s.contact[0][0].restitution = 1.1; }, "contact of 'rock' with 'rock'", "restitution"},
      {[](Scene& s) { s.contact[0][0].friction_coefficient = -0.1; }, "contact of 'rock' with 'rock'", "friction"},
      {[](Scene& s) {
         s.materials.push_back({"steel", 7800});
         s.contact = {{{0.5, 0.5}, {0.5, 0.3}}, {{0.5, 0.4}, {0.5, 0.5}}};
       },
       "contact of 'rock' with 'steel'", "both ways"},
      {[](Scene& s) { s.walls.push_back(floor_wall()); }, "wall 'floor'", "two"},
      {[](Scene& s) { s.walls[0].material = 3; }, "wall 'floor'", "material"},
      {[](Scene& s) {
         s.walls[0].geometry = dem_gpu::Plane{{}, {0, 0, 2}};
       },
       "wall 'floor'", "unit"},
      {[=](Scene& s) {
         s.walls[0].geometry = dem_gpu::Disc{{nan, 0, 0}, {0, 0, 1}, 1};
       },
       "wall 'floor'", "finite"},
      {[](Scene& s) {
         s.walls[0].geometry = dem_gpu::Disc{{}, {0, 0, 1}, 0};
       },
       "wall 'floor'", "radius"},
      {[](Scene& s) {
         s.walls[0].geometry = dem_gpu::Cylinder{{}, {0, 0, 1}, -1, 1};
       },
       "wall 'floor'", "length"},
      {[](Scene& s) {
         s.walls[0].geometry = dem_gpu::Cone{{}, {0, 0, 1}, 1, 0, 0};
       },
       "wall 'floor'", "radii"},
      {[](Scene& s) {
         s.walls[0].geometry = dem_gpu::VolumeObject{dem_gpu::box_part({1, 1, 0})};
       },
       "wall 'floor'", "flat"},
      {[=](Scene& s) { s.walls[0].motion.angular_velocity.x = nan; }, "wall 'floor'", "motion"},
      {[](Scene& s) { s.walls[0].motion.ramp_time = -1; }, "wall 'floor'", "motion"},
      {[](Scene& s) { s.polyhedral_law = dem_gpu::DepthPotential{0}; }, "polyhedra", "stiffness"},
      {[](Scene& s) {
         s.polyhedral_law = dem_gpu::DepthPotential{1e9, 0};
       },
       "polyhedra", "cap"},
      {[](Scene& s) { s.sphere_law = dem_gpu::LinearSpring{-1}; }, "spheres", "stiffness"},
      {[](Scene& s) { s.friction->tangential_stiffness_ratio = -1; }, "friction", "ratio"},
      {[](Scene& s) { s.friction->tangential_stiffness_ratio = 0; }, "friction", "ratio"},
      {[](Scene& s) {
         s.outflow = dem_gpu::Outflow{{0, 0, 0}, 0};
       },
       "outflow", "unit"},
      {[=](Scene& s) { s.gravity.z = nan; }, "gravity", "finite"},
      {[](Scene& s) { s.run.end_time = -1; }, "run", "negative"},
      {[](Scene& s) { s.run.steps_per_contact = 0; }, "run", "steps"},
      {[](Scene& s) { s.run.time_step = shortest_contact_time(s) / 4; }, "run", "use at most"},
  };
  for (const Fault& fault : faults) {
    dem_gpu::Scene scene = good_scene();
    fault.make(scene);
    const std::string message = refusal([&] { check(scene); });
    EXPECT_NE(message.find(fault.place), std::string::npos) << fault.place << ": " << message;
    EXPECT_NE(message.find(fault.words), std::string::npos) << fault.words << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST(TimeStep, IsAShareOfTheStiffestContact) {
  dem_gpu::Scene scene = good_scene();
  scene.bodies.resize(1);  // the cube alone
  // Face against its like: 2 k A with m / 2.
  const Real mass = 2500 * 8e-6, stiffness = 2 * 1e9 * 4e-4;
  EXPECT_NEAR(shortest_contact_time(scene), std::numbers::pi * std::sqrt(mass / 2 / stiffness), 1e-15);
  const Real whole = shortest_contact_time(scene);
  scene.shapes[0] = box_shape({0.02, 0.02, 0.02}, {2, 2, 2});
  EXPECT_NEAR(shortest_contact_time(scene) / whole, 1, 1e-12) << "does not depend on the cut";
  scene.run.steps_per_contact = 50;
  EXPECT_NEAR(time_step(scene), shortest_contact_time(scene) / 50, 1e-18);
  scene.run.time_step = 1e-6;
  EXPECT_EQ(time_step(scene), 1e-6);
}

TEST(TimeStep, CountsTheCornersThatBallsMeet) {
  // A heavy ball on the corner of a square plate, across it: the plate gives way by turning about both its axes, so
  // that the ball meets 1 / (1 + 3 a^2 / (a^2 + t^2) * 2) of its mass.
  constexpr Real kEdge = 0.04, kThickness = 0.004, kStiffness = 1e5;
  dem_gpu::Scene scene = empty_scene(1, 0);
  scene.polyhedral_law = dem_gpu::DepthPotential{1e6};  // soft, so that the ball's contacts set the step
  scene.sphere_law = dem_gpu::LinearSpring{kStiffness};
  scene.materials.push_back({"lead", 2500e3});
  scene.contact.assign(2, {{1, 0}, {1, 0}});
  scene.shapes = {box_shape({kEdge, kEdge, kThickness}), dem_gpu::sphere_shape("ball", 0.01)};
  scene.bodies = {body_at(0, {}), body_at(1, {kEdge / 2 - 1e-4, kEdge / 2 - 1e-4, 0.0125}, {}, {0, 0, -0.1})};
  scene.bodies[1].material = 1;
  const Real share = 1 / (1 + 6 * kEdge * kEdge / (kEdge * kEdge + kThickness * kThickness));
  const Real mass = 2500 * kEdge * kEdge * kThickness;
  EXPECT_NEAR(shortest_contact_time(scene), std::numbers::pi * std::sqrt(share * mass / kStiffness), 1e-12);
  dem_gpu::Simulation simulation(scene);
  run_impact(simulation);
  // The corner itself, 0.1 mm further out, is met by nothing flatter than a sphere's edge; the ball's own mass adds
  // 1e-3.
  EXPECT_GE(simulation.quality().smallest_steps_per_contact, 20);
  EXPECT_LE(simulation.quality().smallest_steps_per_contact, 20.5);
}

TEST(LeastWidth, IsThatOfBoxesSpheresAndTetrahedra) {
  EXPECT_EQ(least_width(dem_gpu::sphere_shape("ball", 0.3)), 0.6);
  EXPECT_NEAR(least_width(box_shape({0.1, 0.02, 0.3}, {2, 1, 3})), 0.02, 1e-15);
  // Height of the regular tetrahedron of edge sqrt 2; its least width, between two edges, is 1 = sqrt(3/4) of it.
  EXPECT_NEAR(least_width(dem_gpu::polyhedral_shape("tetrahedron", {tetrahedron()})), 2 / std::sqrt(Real(3)), 1e-12);
}

}  // namespace
