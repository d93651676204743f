// SPDX-License-Identifier: Apache-2.0
// The scenes that speed is measured on hold the bodies they should, apart from each other and within their walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "catalog/input_error.h"
#include "dem_gpu/simulation.h"
#include "tests/benchmark/scenes/peer_files.h"
#include "tests/benchmark/scenes/placing.h"
#include "tests/benchmark/scenes/resumed_scene.h"
#include "tests/benchmark/scenes/solids.h"
#include "tests/benchmark/scenes/speed_scenes.h"

namespace {

using namespace benchmark_scenes;
using catalog::ConvexFace;
using catalog::ConvexPart;
using dem_gpu::Scene;
using dem_gpu::Vec3;

const std::vector<ConvexPart>& parts_of(const dem_gpu::Shape& shape) {
  return std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts;
}

double mass_of(const Scene& scene) {
  double mass = 0;
  for (const dem_gpu::Body& body : scene.bodies)
    mass += scene.shapes[body.shape].volume * scene.materials[body.material].density;
  return mass;
}

struct Expected {
  const char* scene;
  std::size_t bodies;
  double mass;  // [kg]
};
void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.scene; }

constexpr double kSphere = std::numbers::pi / 6 * 1e-6, kCube8 = 8e-3 * 8e-3 * 8e-3;  // [m3]

class SpeedScenes : public testing::TestWithParam<Expected> {};
INSTANTIATE_TEST_SUITE_P(
    All, SpeedScenes,
    testing::Values(Expected{"s1-box", 10000, 10000 * kSphere * 2500},
                    Expected{"s1-drum", 10000, 10000 * kSphere * 2500}, Expected{"s2", 1000, 1000 * 1e-6 * 2500},
                    Expected{"s3", 500, 250 * (3 + 5) * kCube8 * 2500}, Expected{"s4", 1500, 1500 * 1e-6 * 2500},
                    Expected{"hopper-4", 1000, 1000 * kSphere * 2500},
                    Expected{"hopper-8", 1000, 1000 * kSphere * 2500}, Expected{"mill-4", 1000, 1000 * kSphere * 2500},
                    Expected{"mill-8", 1000, 1000 * kSphere * 2500}));

TEST_P(SpeedScenes, HoldTheirBodies) {
  const Scene scene = speed_scene(GetParam().scene).make({});
  EXPECT_EQ(scene.bodies.size(), GetParam().bodies);
  EXPECT_NEAR(mass_of(scene), GetParam().mass, 1e-9 * GetParam().mass);
}

TEST_P(SpeedScenes, BeginWithNothingTouching) {
  for (const int bodies : {0, 2000, 5000}) {
    SceneOptions options;
    options.bodies = bodies;
    const Scene scene = speed_scene(GetParam().scene).make(options);
    EXPECT_EQ(scene.bodies.size(), bodies > 0 ? bodies : GetParam().bodies);
    EXPECT_EQ(dem_gpu::Simulation(scene).bulk().contacts, 0) << bodies << " bodies";
  }
}

TEST_P(SpeedScenes, AreTheSameEachTime) {
  const Scene one = speed_scene(GetParam().scene).make({}), other = speed_scene(GetParam().scene).make({});
  for (std::size_t i = 0; i < one.bodies.size(); ++i) {
    EXPECT_EQ(one.bodies[i].position, other.bodies[i].position);
    EXPECT_EQ(one.bodies[i].orientation.w, other.bodies[i].orientation.w);
  }
}

TEST(SpeedScene, KeepsItsDepthAndStepWhenItWidens) {
  for (const char* name : {"s1-box", "s2", "s3"}) {
    const auto height_of = [&](int bodies) {
      SceneOptions options;
      options.bodies = bodies;
      const Scene scene = speed_scene(name).make(options);
      double height = 0;
      for (const dem_gpu::Body& body : scene.bodies) height += body.position.z / static_cast<double>(bodies);
      return height;
    };
    // Whole numbers of bodies across the box: the lattice is a little denser or wider.
    EXPECT_NEAR(height_of(20000) / height_of(5000), 1, 0.12) << name;
  }
}

TEST(SpeedScene, HasOneTimeStepWithBothLaws) {
  SceneOptions depth, volume;
  volume.law = Law::overlap_volume;
  for (const char* name : {"s2", "s3", "s4"})
    EXPECT_DOUBLE_EQ(dem_gpu::time_step(speed_scene(name).make(depth)),
                     dem_gpu::time_step(speed_scene(name).make(volume)));
}

TEST(SpeedScene, OfAnUnknownNameIsRefused) {
  EXPECT_THROW(speed_scene("s1-bax"), catalog::UsageError);
  EXPECT_THROW(rough_rock(5, 1, 1), catalog::InputError);
}

TEST(ResumedScene, GoesOnFromASnapshot) {
  SceneOptions options;
  options.bodies = 60;
  const Scene scene = outlet_box(options);
  dem_gpu::Simulation simulation(scene);
  simulation.advance(100);
  dem_gpu::Snapshot snapshot = simulation.snapshot();
  snapshot.active[7] = 0;
  const Scene next = resumed(scene, snapshot);
  ASSERT_EQ(next.bodies.size(), 59u);
  EXPECT_EQ(next.bodies[6].position, snapshot.position[6]);
  EXPECT_EQ(next.bodies[7].position, snapshot.position[8]);
  EXPECT_EQ(next.bodies[7].velocity, snapshot.velocity[8]);
  EXPECT_EQ(next.bodies[7].shape, scene.bodies[8].shape);
  EXPECT_DOUBLE_EQ(next.walls.back().removed_at.value(), kOutletOpens - snapshot.time);
  EXPECT_THROW(resumed(next, snapshot), catalog::InputError);
}

/// Lines of a text that begin with a number.
int number_lines(const std::string& text) {
  int count = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) count += std::isdigit(static_cast<unsigned char>(line[0]));
  return count;
}

TEST(PeerFiles, NameEachBodyOnce) {
  SceneOptions options;
  options.bodies = 40;
  EXPECT_EQ(number_lines(particle_table(mixed_box(options))), 40);
  options.bodies = 500;
  const Scene drum = sphere_drum(options);
  const std::string text = lammps_particles(drum);
  EXPECT_NE(text.find("500 atoms\n"), std::string::npos);
  // The axis, y here, is z there; down, -z here, is -x there.
  std::istringstream first(text.substr(text.find("Atoms\n\n") + 7));
  int id = 0, type = 0;
  double diameter = 0, density = 0;
  Vec3 place;
  first >> id >> type >> diameter >> density >> place.x >> place.y >> place.z;
  EXPECT_EQ(id, 1);
  EXPECT_EQ(type, 1);
  EXPECT_EQ(diameter, 0.01);
  EXPECT_EQ(density, 2500);
  EXPECT_EQ(place, (Vec3{drum.bodies[0].position.z, drum.bodies[0].position.x, drum.bodies[0].position.y}));
}

TEST(PeerFiles, RefuseWhatThePeersDoNotHave) {
  EXPECT_THROW(lammps_particles(mixed_box({})), catalog::InputError);
  EXPECT_THROW(particle_table(outlet_box({})), catalog::InputError);
}

/// Corners of a face, to a millionth of the body.
std::set<std::array<long, 3>> corners_of(const ConvexPart& part, const ConvexFace& face, double size) {
  std::set<std::array<long, 3>> corners;
  for (const int v : face.vertices) {
    const catalog::Point& p = part.vertices[v];
    corners.insert({std::lround(1e6 * p[0] / size), std::lround(1e6 * p[1] / size), std::lround(1e6 * p[2] / size)});
  }
  return corners;
}

/// Faces of other parts on the other side of the same cut.
int faces_across(const std::vector<ConvexPart>& parts, const ConvexPart& part, const ConvexFace& face, double size) {
  int count = 0;
  for (const ConvexPart& other : parts)
    for (const ConvexFace& candidate : other.faces)
      if (&other != &part && candidate.kind == catalog::FaceKind::inner &&
          candidate.plane.offset == -face.plane.offset && candidate.plane.normal[0] == -face.plane.normal[0] &&
          candidate.plane.normal[1] == -face.plane.normal[1] && candidate.plane.normal[2] == -face.plane.normal[2] &&
          corners_of(other, candidate, size) == corners_of(part, face, size))
        ++count;
  return count;
}

void expect_partition(const dem_gpu::Shape& shape, std::size_t part_count, int inner_faces) {
  const std::vector<ConvexPart>& parts = parts_of(shape);
  EXPECT_EQ(parts.size(), part_count);
  int inner = 0;
  for (const ConvexPart& part : parts)
    for (const ConvexFace& face : part.faces) {
      if (face.kind != catalog::FaceKind::inner) continue;
      ++inner;
      EXPECT_EQ(faces_across(parts, part, face, bounding_radius(shape)), 1) << shape.name;
    }
  EXPECT_EQ(inner, inner_faces) << shape.name;
}

TEST(Solids, MeetTheirPartsAtWholeFaces) {
  expect_partition(three_cube_l(0.008), 3, 4);
  expect_partition(four_part_cross(0.008), 4, 6);
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    expect_partition(rough_rock(4, 0.01, seed), 4, 12);
    expect_partition(rough_rock(8, 0.01, seed), 8, 24);
  }
}

TEST(Solids, HaveTheMomentsOfTheirForms) {
  const double a = 0.01, b = 0.008;
  EXPECT_NEAR(cube(a).principal_inertia.x, std::pow(a, 5) / 6, 1e-12 * std::pow(a, 5));
  // A regular tetrahedron of edge 3 less four of edge 1: volume (27 - 4) / (6 sqrt 2); edge sqrt(8) s, corners at
  // sqrt(11) s.
  const dem_gpu::Shape truncated = truncated_tetrahedron(1e-6);
  const double edge = std::cbrt(1e-6 * 6 * std::numbers::sqrt2 / 23);
  EXPECT_NEAR(truncated.volume, 1e-6, 1e-18);
  EXPECT_NEAR(bounding_radius(truncated), edge * std::sqrt(11.0 / 8), 1e-12);
  ASSERT_EQ(parts_of(truncated).size(), 1u);
  EXPECT_EQ(parts_of(truncated)[0].vertex_count(), 12u);
  EXPECT_EQ(parts_of(truncated)[0].face_count(), 8u);
  // About the axis across the plane: five squares, four of them one edge off the middle.
  const dem_gpu::Shape cross = four_part_cross(b);
  EXPECT_NEAR(cross.principal_inertia.z, (5.0 / 6 + 4) * std::pow(b, 5), 1e-9 * std::pow(b, 5));
}

TEST(Solids, RoughRocksAreNotConvex) {
  for (const int parts : {4, 8}) {
    const dem_gpu::Shape rock = rough_rock(parts, 0.01, 1);
    // Some corner of a part stands beyond the plane of another part's outer face.
    double beyond = 0;
    for (const ConvexPart& part : parts_of(rock))
      for (const ConvexFace& face : part.faces)
        if (face.kind == catalog::FaceKind::outer)
          for (const ConvexPart& other : parts_of(rock))
            for (const catalog::Point& p : other.vertices) {
              const catalog::Point& n = face.plane.normal;
              beyond = std::max(beyond, n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - face.plane.offset);
            }
    EXPECT_GT(beyond, 0.01 * 0.01) << parts;
    EXPECT_NEAR(rock.volume, kSphere, 1e-9 * kSphere);
  }
}

TEST(Solids, FacetedBallsHaveTheFacesOfATriangulatedBall) {
  for (const int corners : {12, 32, 60}) {
    const dem_gpu::Shape ball = faceted_ball(corners, 0.01);
    EXPECT_EQ(parts_of(ball)[0].vertex_count(), static_cast<std::size_t>(corners));
    EXPECT_EQ(parts_of(ball)[0].face_count(), static_cast<std::size_t>(2 * corners - 4));
    EXPECT_NEAR(ball.volume, kSphere, 1e-9 * kSphere);
  }
}

}  // namespace
