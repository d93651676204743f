// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/round_frame.h"

#include <gtest/gtest.h>

#include "catalog/mass_properties.h"
#include "decomposition/geometry/random.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

catalog::TriangleMesh turned(catalog::TriangleMesh mesh, std::uint64_t seed) {
  Random random(seed);
  const Frame frame = random_frame(random);
  for (catalog::Point& p : mesh.vertices) p = to_point(frame(to_vec3(p)));
  return mesh;
}

TEST(RoundFrame, CompactBodiesStayAsTheyAre) {
  const RoundFrame frame(turned(solids::scaled(solids::sphere(1, 3), {5.9, 2, 1}), 1));
  EXPECT_TRUE(frame.is_identity());
  const Plane plane{normalized({1, 2, 3}), 0.7};
  EXPECT_EQ(frame.to_real(plane).offset, plane.offset);
  EXPECT_EQ(to_point(frame.to_real(plane).normal), to_point(plane.normal));
}

TEST(RoundFrame, NeedlesAndPlatesBecomeRoundAndComeBack) {
  for (const catalog::Point& axes :
       {catalog::Point{50, 1, 1}, catalog::Point{1, 20, 20}, catalog::Point{1000, 30, 1}}) {
    const catalog::TriangleMesh mesh =
        solids::moved(turned(solids::scaled(solids::sphere(1, 3), axes), 2), {1e4, 0, -3e3});
    const RoundFrame frame(mesh);
    ASSERT_FALSE(frame.is_identity());
    const catalog::TriangleMesh round = frame.to_round(mesh);
    const catalog::Point inertia = catalog::mass_properties(round).principal_inertia;
    // Semi-axes within a factor of two of one another: inertia of an ellipsoid 2 : 1 : 1 differs by 5 / 2.
    EXPECT_LT(inertia[2] / inertia[0], 2.5);
    EXPECT_GT(catalog::mass_properties(round).volume, 0) << "turned inside out";
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)  // 1e-16 of the largest coordinate, times a few operations
      EXPECT_LT(norm(frame.to_real(to_vec3(round.vertices[v])) - to_vec3(mesh.vertices[v])), 1e-11);
  }
}

TEST(RoundFrame, PlanesKeepTheirPointsAndTheirReverseBits) {
  const RoundFrame frame(turned(solids::scaled(solids::sphere(1, 3), {40, 3, 1}), 3));
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const Plane plane{random.unit_vector(), random.uniform() - 0.5};
    const Plane real = frame.to_real(plane), reversed = frame.to_real(plane.reversed());
    EXPECT_EQ(to_point(reversed.normal), to_point(-real.normal));
    EXPECT_EQ(reversed.offset, -real.offset);
    EXPECT_NEAR(norm(real.normal), 1, 1e-15);
    Vec3 u, v;
    plane_axes(plane.normal, u, v);
    const Vec3 on = plane.offset * plane.normal + random.uniform() * u + random.uniform() * v;
    EXPECT_NEAR(real.signed_distance(frame.to_real(on)), 0, 1e-13);
    EXPECT_LT(real.signed_distance(frame.to_real(on - 0.1 * plane.normal)), 0) << "the half-space is another";
  }
}

// A box drawn along the axes near the origin comes back bit for bit: its parts have the corners that were drawn.
TEST(RoundFrame, DrawnBoxesComeBackExactly) {
  const catalog::TriangleMesh box = solids::box({0, 0, 0}, {0.3, 7.1, 0.2});
  const RoundFrame frame(box);
  ASSERT_FALSE(frame.is_identity());
  const catalog::TriangleMesh round = frame.to_round(box);
  for (std::size_t v = 0; v < box.vertex_count(); ++v)
    EXPECT_EQ(to_point(frame.to_real(to_vec3(round.vertices[v]))), box.vertices[v]);
}

// The width of a plate turned anyhow is missed by directions spread over the sphere, not by those of its frame.
TEST(RoundFrame, SmallestExtentOfATurnedPlate) {
  const catalog::TriangleMesh mesh = turned(solids::scaled(solids::sphere(1, 4), {300, 300, 1}), 5);
  std::vector<Vec3> points;
  for (const catalog::Point& p : mesh.vertices) points.push_back(to_vec3(p));
  EXPECT_NEAR(smallest_extent(points, RoundFrame(mesh)), 2, 1e-9);  // one of the directions is the axis
}

}  // namespace
}  // namespace decomposition
