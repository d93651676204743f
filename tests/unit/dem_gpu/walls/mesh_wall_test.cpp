// SPDX-License-Identifier: Apache-2.0
// Mesh walls: what is refused and how, the field's energy and force, distances.
#include <gtest/gtest.h>

#include "catalog/input_error.h"
#include "dem_gpu/mesh_probe.h"
#include "dem_gpu/meshes/contact_surface.h"
#include "dem_gpu/meshes/mesh_integrals.h"
#include "tests/support/pair_integrals.h"
#include "tests/support/solids.h"
#include "tests/support/wall_meshes.h"

namespace {

using namespace test_support;
using catalog::TriangleMesh;
using dem_gpu::MeshObject;

std::string refusal(const MeshObject& object) {
  try {
    contact_surface(object);
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeshWall, RefusesWithTheRemedy) {
  const TriangleMesh cube = solids::box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(refusal({cube}), "accepted");
  TriangleMesh open = cube;
  open.faces.pop_back();
  EXPECT_NE(refusal({open}).find("give the sheet a thickness"), std::string::npos);
  EXPECT_EQ(refusal({open, 0.1}), "accepted");
  TriangleMesh inverted = cube;
  for (auto& face : inverted.faces) std::swap(face[0], face[1]);
  EXPECT_NE(refusal({inverted}).find("inverted"), std::string::npos);
  EXPECT_EQ(refusal({inverted, std::nullopt, true}), "accepted") << "a container";
  EXPECT_EQ(refusal({cube, std::nullopt, true}), "accepted") << "turned round";
  TriangleMesh mixed = cube;
  std::swap(mixed.faces[3][0], mixed.faces[3][1]);
  EXPECT_NE(refusal({mixed}).find("wound in opposite ways"), std::string::npos);
  TriangleMesh needle = cube;
  needle.vertices.push_back({0.5, 0, 0});
  needle.faces.push_back({0, 8, 1});
  EXPECT_NE(refusal({needle}).find("triangle 12 has no area"), std::string::npos);
  TriangleMesh crossed = cube;
  for (const auto& p : solids::box({0.5, 0.4, 0.4}, {1.5, 0.6, 0.6}).vertices) crossed.vertices.push_back(p);
  for (const auto& [a, b, c] : cube.faces) crossed.faces.push_back({a + 8, b + 8, c + 8});
  EXPECT_NE(refusal({crossed}).find("pass through each other"), std::string::npos);
  EXPECT_NE(refusal({TriangleMesh{}}).find("no triangles"), std::string::npos);
  const TriangleMesh tent{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0.02}, {1, 0, -0.02}}, {{0, 2, 1}, {1, 3, 0}}};
  EXPECT_NE(refusal({tent, 0.1}).find("folded"), std::string::npos);
}

/// One mesh of several, each as it is.
TriangleMesh together(const std::vector<TriangleMesh>& pieces) {
  TriangleMesh all;
  for (const TriangleMesh& piece : pieces) {
    const int first = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), piece.vertices.begin(), piece.vertices.end());
    for (const auto& [a, b, c] : piece.faces) all.faces.push_back({first + a, first + b, first + c});
  }
  return all;
}

TriangleMesh turned_round(TriangleMesh mesh) {
  for (auto& face : mesh.faces) std::swap(face[0], face[1]);
  return mesh;
}

TEST(MeshWall, JudgesEachShellByItself) {
  const TriangleMesh cube = solids::box({0, 0, 0}, {1, 1, 1}), beside = solids::box({2, 0, 0}, {2.5, 0.5, 0.5}),
                     cavity = turned_round(solids::box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8})),
                     core = solids::box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6});
  EXPECT_EQ(refusal({together({cube, beside})}), "accepted");
  EXPECT_EQ(refusal({together({cube, cavity, beside})}), "accepted");
  EXPECT_EQ(refusal({together({core, cavity, cube})}), "accepted") << "solid, hole, solid from outside in";
  const std::string alone = refusal({together({cube, turned_round(beside)})});
  EXPECT_NE(alone.find("the shell of triangle 12 (12 of the mesh's triangles) is inverted"), std::string::npos)
      << alone;
  const std::string within = refusal({together({turned_round(cavity), cube})});
  EXPECT_NE(within.find("the shell of triangle 0 "), std::string::npos) << within;
  EXPECT_NE(within.find("if it is a cavity, or remove it"), std::string::npos) << within;
  EXPECT_NE(refusal({together({cube, cavity, turned_round(core)})}).find("triangle 24 "), std::string::npos);
}

TEST(MeshWall, AContainersShellsAreTurnedToTheirSolid) {
  // A room with a pillar in it: solid about the room and in the pillar, however the file winds them.
  const TriangleMesh room = solids::box({0, 0, 0}, {1, 1, 1}), pillar = solids::box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6});
  for (const bool room_turned : {false, true})
    for (const bool pillar_turned : {false, true}) {
      const TriangleMesh mesh =
          together({room_turned ? turned_round(room) : room, pillar_turned ? turned_round(pillar) : pillar});
      const dem_gpu::MeshProbe probe(MeshObject{mesh, std::nullopt, true});
      EXPECT_NEAR(probe.distance({0.2, 0.5, 0.5}), 0.2, 1e-12);
      EXPECT_NEAR(probe.distance({0.3, 0.5, 0.5}), 0.1, 1e-12) << "from the pillar";
      EXPECT_LT(probe.distance({0.5, 0.5, 0.5}), 0) << "in the pillar";
      EXPECT_LT(probe.distance({-0.1, 0.5, 0.5}), 0) << "about the room";
    }
}

/// A cube of edge 0.4 against a mesh wall, and the energy U = integral of the field over the overlap by sampling.
class MeshField {
 public:
  explicit MeshField(const MeshObject& object) : part_({unit_cube()}, {unit_cube()}) {
    append_mesh(columns_, object, 1);
  }
  dem_gpu::WallIntegrals at(const Placed& body) const {
    const dem_gpu::MeshView mesh = view(columns_);
    const auto view = dem_gpu::part_view(dem_gpu::view(part_.columns()), 0);
    const dem_gpu::PlacedPart placed(view, {rotation_matrix(body.orientation), {}, body.scale});
    dem_gpu::WallIntegrals integrals;
    for (const auto& facet : columns_.facets)
      EXPECT_TRUE(integrate_part_in_cell(placed, mesh, facet, body.position, integrals));
    return integrals;
  }
  /// Largest number of cells that hold one of the points, the cells' rims left out.
  int most_cells(const std::vector<Vec3>& points) const {
    int most = 0;
    for (const Vec3& x : points) {
      int count = 0;
      for (const auto& facet : columns_.facets) {
        bool is_in = true;
        for (int p = 0; p < facet.plane_count; ++p)
          is_in = is_in && depth_below(columns_.planes[facet.first_plane + p], x) > 1e-9;
        count += is_in;
      }
      most = std::max(most, count);
    }
    return most;
  }

 private:
  PairIntegrals part_;
  dem_gpu::HostMeshColumns columns_;
};

TEST(MeshWall, CellsDoNotOverlap) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> coordinate(0, 2);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i) points.push_back({coordinate(random), coordinate(random), coordinate(random)});
  // A convex solid of any cut; an L of whole faces. (A finely cut re-entrant edge has overlaps behind it.)
  for (const int cut : {1, 4})
    EXPECT_EQ(MeshField({solids::voxels(
                            2, [](int, int, int k) { return k == 0; }, cut)})
                  .most_cells(points),
              1)
        << "a block, each square of " << 2 * cut * cut << " triangles";
  EXPECT_EQ(MeshField({solids::l_shape()}).most_cells(points), 1);
}

TEST(MeshWall, ForceIsTheGradientOfOneEnergyAroundTheCornersOfAnL) {
  // Work along a closed path that enters the solid over its edges and its inner corner, turning: trapezium rule.
  const MeshField field({solids::l_shape()});
  const auto pose = [](Real s) {
    return Placed{{1.15 + 0.25 * std::cos(s), 1.15 + 0.25 * std::sin(s), 0.9 + 0.4 * std::sin(2 * s)},
                  dem_gpu::axis_angle(Vec3{0.6, 0.8, 0}, 0.4 * std::sin(s)),
                  0.4};
  };
  constexpr int kSteps = 4000;
  Real work = 0, least = 0, most = 0;
  for (int i = 0; i < kSteps; ++i) {
    const Real s = 2 * M_PI * (i + 0.5) / kSteps, h = 1e-5;
    const auto contact = field.at(pose(s));
    const Placed before = pose(s - h), after = pose(s + h);
    const auto turn = after.orientation * dem_gpu::conjugate(before.orientation);
    work +=
        (dot(contact.force, after.position - before.position) + 2 * dot(contact.moment, Vec3{turn.x, turn.y, turn.z})) /
        (2 * h) * 2 * M_PI / kSteps;
    least = std::min(least, work);
    most = std::max(most, work);
  }
  EXPECT_GT(most - least, 1e-4) << "the path goes through the solid";
  // What the default law is asked to keep; the sum's own error is some 1e-6.
  EXPECT_LT(std::abs(work), 1e-5 * (most - least));
}

TEST(MeshWall, AThinPlateHoldsFromBothSides) {
  const MeshField plate({flat_sheet(4, 6), 0.1});
  const Real d = 0.02;
  const auto above = plate.at({{0.1, 0.2, 0.2 - d}, {}, 0.4}), below = plate.at({{0.1, 0.2, -0.3 + d}, {}, 0.4});
  // A face of 0.4 x 0.4 pressed in by d: the integral of depth is area times d.
  EXPECT_NEAR(above.force.z, 0.16 * d, 1e-12 + kSingle.position * 0.16);
  EXPECT_NEAR(below.force.z, -0.16 * d, 1e-11 + kSingle.position * 0.16)
      << "the back stands off by 1e-9 of the thickness";
}

TEST(MeshWall, DistanceIsSignedAndNearest) {
  const dem_gpu::MeshProbe ball({solids::sphere(1, 4)});
  std::mt19937 random(8);
  for (int i = 0; i < 200; ++i) {
    const Real r = std::uniform_real_distribution<Real>(0.5, 1.5)(random);
    // 2048 triangles of a sphere: chords leave it by at most 0.4 %.
    EXPECT_NEAR(ball.distance(r * random_direction(random)), r - 1, 0.004);
  }
  const dem_gpu::MeshProbe box({solids::box({0, 0, 0}, {1, 1, 1})});
  EXPECT_NEAR(box.distance({2, 2, 2}), std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(box.distance({0.5, 0.5, 0.9}), -0.1, 1e-14);
}

}  // namespace
