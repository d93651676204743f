// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/grooved_block.h"
#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;
using dem_gpu::ContactPatch;
using dem_gpu::ElasticContact;
using dem_gpu::Mat3;
using Integrals = dem_gpu::DepthIntegralsOf<dem_gpu::LinearProfile, dem_gpu::PatchSums>;

struct Found {
  ElasticContact contact;
  ContactPatch patch;
};

Found find(const PairIntegrals& pair, const Placed& a, const Placed& b) {
  const Integrals integrals = pair.of<Integrals>(a, b);
  const dem_gpu::DepthPotential law{1};
  Found found;
  EXPECT_TRUE(integrals.to_contact(law, a.pose(), found.contact));
  found.patch = integrals.to_patch(law, a.pose(), found.contact);
  return found;
}

void expect_same(const Mat3& got, const Mat3& expected, double tolerance) {
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    EXPECT_LT(norm(got * axis - expected * axis), tolerance);
}
Mat3 outer(const Vec3& n) {
  Mat3 sum{{}, {}, {}};
  add_outer_product(sum, 1, n);
  return sum;
}

TEST(Patch, FaceOnFaceHasTheSquaresLever) {
  const PairIntegrals pair({unit_cube()}, {dem_gpu::box_part({4, 4, 1})});
  for (const double d : {1e-4, 1e-6}) {
    if (kIsMixed && d < 1e-5) continue;  // touching
    const Found found = find(pair, {{0.3, 0.2, 1 - d}, {}}, {});
    expect_same(found.patch.normals, outer({0, 0, 1}), 1e-12 + kSingle.integral);
    // The rim, d wide, carries less; uniform over the rest.
    EXPECT_NEAR(found.patch.lever, 1 / std::sqrt(6.0), 2 * d + kSingle.position / d);
    EXPECT_NEAR(found.patch.load / norm(found.contact.force), 1, 1e-9 + kSingle.integral);
  }
}

TEST(Patch, CornersAndEdgesAreOneContactWithTheNormalOfTheFlatSide) {
  const PairIntegrals on_slab({unit_cube()}, {dem_gpu::box_part({4, 4, 1})});
  std::mt19937 random(2);
  const Quaternion leaning = normalized(vertex_down() * dem_gpu::axis_angle(random_direction(random), 0.2));
  for (const Quaternion& turn : {edge_down(), vertex_down(), leaning}) {
    double lowest = 0;
    for (const auto& v : unit_cube().vertices) lowest = std::min(lowest, double(rotate(turn, to_vec3(v)).z));
    const Found found = find(on_slab, {{0.1, 0, 0.5 - lowest - 0.02}, turn}, {});
    expect_same(found.patch.normals, outer({0, 0, 1}), 1e-12 + kSingle.integral);
    EXPECT_NEAR(found.patch.load / norm(found.contact.force), 1, 1e-12 + kSingle.integral);
  }
  // Edge across edge.
  const PairIntegrals cubes({unit_cube()}, {unit_cube()});
  const Quaternion across = normalized(dem_gpu::axis_angle({0, 0, 1}, M_PI / 2) * edge_down());
  const Found found = find(cubes, {{0, 0, std::sqrt(2.0) - 0.05}, edge_down()}, {{}, across});
  expect_same(found.patch.normals, outer({0, 0, 1}), 1e-12 + kSingle.integral);
  EXPECT_NEAR(found.patch.load / norm(found.contact.force), 1, 1e-12 + kSingle.integral);
}

TEST(Patch, InnerCornerLoadsBothItsFaces) {
  const Vec3 left{-std::sqrt(0.5), 0, std::sqrt(0.5)}, right{std::sqrt(0.5), 0, std::sqrt(0.5)};
  Mat3 expected{{}, {}, {}};
  add_outer_product(expected, 0.5, left);
  add_outer_product(expected, 0.5, right);
  std::mt19937 random(8);
  Found first;
  for (const int slices : {1, 2, 4}) {
    const PairIntegrals pair(grooved_block(slices), {roof_part()});
    const Found found = find(pair, {{0, 0, -0.015 - 1e-5}, {}}, {});
    // The rims along the groove's edge meet the other face's field: of the order of depth over width, 1e-5 / 0.021.
    expect_same(found.patch.normals, expected, 5e-4);
    EXPECT_NEAR(found.patch.load / norm(found.contact.force), std::sqrt(2.0), 2e-3);
    if (slices == 1) first = found;
    EXPECT_NEAR(found.patch.load / first.patch.load, 1, 1e-10 + kSingle.integral) << "cut " << slices;
    EXPECT_NEAR(found.patch.lever / first.patch.lever, 1, 1e-10 + kSingle.integral);
    // The same, moved and turned as one.
    const Quaternion turn = random_rotation(random);
    const Vec3 shift{3, -2, 1};
    const Found moved = find(pair, {shift + rotate(turn, {0, 0, -0.015 - 1e-5}), turn}, {shift, turn});
    // The poses are rounded anew; the block's reach is 0.05, its depth 1e-5.
    EXPECT_NEAR(moved.patch.load / found.patch.load, 1, 1e-9 + kSingle.position * 0.05 / 1e-5);
    expect_same(moved.patch.normals, rotated(found.patch.normals, rotation_matrix(turn)),
                1e-9 + kSingle.position * 0.05 / 1e-5);
  }
}

TEST(Patch, SecondMomentOfATriangle) {
  const dem_gpu::DepthTriangle t{{0.3, 0.1, -0.2}, {1.1, 0.4, 0.3}, {-0.2, 0.9, 0.6}, 0.3, 0.7, 0.2, 0.4};
  // Midpoint rule over n^2 equal triangles: second order.
  const auto by_pieces = [&](Real rate) {
    const int n = 600;
    Real sum = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n - i; ++j)
        for (int upper = 0; upper < (i + j < n - 1 ? 2 : 1); ++upper) {
          const Real u = (i + (upper + 1) / Real(3)) / n, v = (j + (upper + 1) / Real(3)) / n, w = 1 - u - v;
          const Real depth = u * t.depth_a + v * t.depth_b + w * t.depth_c;
          sum += depth * (1 + rate * depth) * norm_squared(u * Vec3(t.a) + v * Vec3(t.b) + w * Vec3(t.c));
        }
    return t.area * sum / (Real(n) * n);
  };
  EXPECT_NEAR(dem_gpu::LinearProfile{}.second_moment(t) / by_pieces(0), 1, 1e-5);
  for (const Real rate : {0., 2., 30.})
    EXPECT_NEAR(dem_gpu::HardeningProfile{dem_gpu::rounded(rate)}.second_moment(t) / by_pieces(rate), 1, 1e-5);
  EXPECT_NEAR(dem_gpu::HardeningProfile{0}.second_moment(t), dem_gpu::LinearProfile{}.second_moment(t),
              1e-14 + kSingle.integral);
}

}  // namespace
