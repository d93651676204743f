// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/narrow_phase/closing_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <utility>

#include "tests/support/non_convex_bodies.h"
#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;
using dem_gpu::ClosingPlanes;
using dem_gpu::FaceSet;
using dem_gpu::FrameChange;
using dem_gpu::Meeting;
using dem_gpu::PartPair;
using dem_gpu::PartView;
using dem_gpu::Polygon;
using Integrals = dem_gpu::VolumeIntegralsOf<dem_gpu::PatchSums>;

PartView part_of_a(const PairIntegrals& bodies, int part = 0) { return part_view(view(bodies.columns()), part); }

FaceSet set_of(std::initializer_list<int> faces) {
  FaceSet set;
  for (const int f : faces) set.add(f);
  return set;
}
/// The first one that looks along a direction.
int face_along(const PartView& part, const Vec3& direction) {
  int best = 0;
  for (int f = 1; f < part.range.face_count; ++f)
    if (dot(Vec3(part.planes[f].normal), direction) > dot(Vec3(part.planes[best].normal), direction) + 1e-4) best = f;
  return best;
}

void expect_dual(const ClosingPlanes& planes) {
  for (int i = 0; i < planes.count; ++i)
    for (int j = 0; j < planes.count; ++j)
      EXPECT_NEAR(dot(planes.normal[i], planes.dual[j]), i == j, 1e-14 + kSingle.integral) << i << j;
}

TEST(ClosingPlanes, MeetInTheApex) {
  std::mt19937 random(5);
  int found = 0, refused = 0;
  for (int i = 0; i < 200; ++i) {
    const PairIntegrals bodies({random_convex_part(random, 4)}, {unit_cube()});
    const PartView part = part_of_a(bodies);
    const Vec3 near = random_direction(random);
    for (int f = 0; f < 4; ++f)
      for (const FaceSet& faces : {set_of({f}), set_of({f, (f + 1) % 4}), set_of({f, (f + 1) % 4, (f + 2) % 4})}) {
        ClosingPlanes planes;
        if (!planes.find(part, faces, near)) {
          ++refused;
          continue;
        }
        ++found;
        expect_dual(planes);
        for (FaceSet left = faces; !left.is_empty(); left = left.without_lowest())
          EXPECT_NEAR(depth_below<Real>(part.planes[left.lowest()], planes.apex), 0, 1e-13 + 10 * kSingle.position);
        // Nearest of the points that they have in common.
        if (planes.count == 1) {
          EXPECT_LE(norm(cross(planes.apex - near, planes.normal[0])), 1e-14 + kSingle.integral);
        }
        if (planes.count == 2) {
          EXPECT_NEAR(dot(planes.apex - near, cross(planes.normal[0], planes.normal[1])), 0, 1e-13 + kSingle.integral);
        }

        const FrameChange change{rotation_matrix(random_rotation(random)), {1, -2, 3}, 2.5};
        const ClosingPlanes moved = planes.moved(change);
        expect_dual(moved);
        EXPECT_LE(norm(moved.apex - change.point(planes.apex)), 1e-13);
        EXPECT_LE(norm(moved.normal[0] - change.direction(planes.normal[0])), 1e-15);
      }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(refused, 100);
}

TEST(ClosingPlanes, AreThreeAtMostAndNoneOpposite) {
  const PairIntegrals bodies({unit_cube()}, {unit_cube()});
  const PartView cube = part_of_a(bodies);
  ClosingPlanes planes;
  EXPECT_TRUE(planes.find(cube, {}, {0.1, 0.2, 0.3}));
  EXPECT_EQ(planes.count, 0);
  EXPECT_EQ(norm(planes.apex - Vec3{0.1, 0.2, 0.3}), 0);
  ASSERT_TRUE(planes.find(cube, set_of({1, 2, 5}), {0.1, 0.2, 0.3}));
  EXPECT_LE(norm(planes.apex - Vec3{0.5, -0.5, 0.5}), 1e-15);
  EXPECT_FALSE(planes.find(cube, set_of({0, 1}), {}));
  EXPECT_FALSE(planes.find(cube, set_of({0, 1, 2}), {}));
  EXPECT_FALSE(planes.find(cube, set_of({0, 2, 4, 5}), {}));
  EXPECT_FALSE(planes.find(cube, FaceSet::all(), {}));
}

TEST(ClosingPlanes, AreNotNearlyParallel) {
  for (const auto& [determinant, is_found] : {std::pair(0.101, true), std::pair(0.099, false)}) {
    const Real rise = std::tan(std::asin(std::sqrt(determinant)) / 2);  // of a roof
    const std::vector<Vec3> vertices{{-1, -1, 0}, {1, -1, 0}, {0, -1, rise}, {-1, 1, 0}, {1, 1, 0}, {0, 1, rise}};
    const PairIntegrals bodies({part_of(vertices, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {0, 2, 5, 3}, {1, 4, 5, 2}})},
                               {unit_cube()});
    const PartView roof = part_of_a(bodies);
    const int left = face_along(roof, {-rise, 0, 1}), right = face_along(roof, {rise, 0, 1});
    ASSERT_NE(left, right);
    ClosingPlanes planes;
    EXPECT_EQ(planes.find(roof, set_of({left, right}), {}), is_found);
    EXPECT_TRUE(planes.find(roof, set_of({left, face_along(roof, {0, 1, 0})}), {}));
  }
}

TEST(ClosingPlanes, AreOuterOrInnerEach) {
  ClosingPlanes planes;
  const PairIntegrals halves(cut_box({1, 1, 1}, {2, 1, 1}), {unit_cube()});
  const PartView half = part_of_a(halves);
  const int inner = face_along(half, {1, 0, 0}), outer = face_along(half, {0, 1, 0});
  ASSERT_GE(inner, half.range.outer_face_count);
  ASSERT_TRUE(planes.find(half, set_of({inner, outer}), {}));
  EXPECT_LE(norm(planes.dual_of_outer() - Vec3{0, 1, 0}), 1e-15);
  EXPECT_LE(norm(planes.outer_area({-2, -3, 0}) - Vec3{0, 3, 0}), 1e-15);
  ASSERT_TRUE(planes.find(half, set_of({inner}), {}));
  EXPECT_EQ(norm(planes.dual_of_outer()), 0);

  // Of the side towards y the other box covers half; that below is two outer faces in one plane.
  const PairIntegrals l_body(l_in_2(), {unit_cube()});
  const PartView box = part_of_a(l_body);
  const int below = face_along(box, {0, -1, 0});
  EXPECT_FALSE(planes.find(box, set_of({face_along(box, {0, 1, 0})}), {}));
  EXPECT_TRUE(planes.find(box, set_of({below}), {}));
  int others = 0;
  for (int f = below + 1; f < box.range.face_count; ++f)
    if (box.faces[f].plane == below) {
      ++others;
      EXPECT_FALSE(planes.find(box, set_of({f}), {}));
    }
  EXPECT_EQ(others, 1);
}

TEST(ClosingPlanes, HoldFacesThatNoPieceReaches) {
  // A spike out of a boulder's top: its base lies deep in the boulder, whose surface meets its sides alone.
  const PairIntegrals bodies({dem_gpu::box_part({4, 4, 4})},
                             {hull_of({{0, 0, 2.5}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}})});
  const PartView boulder = part_of_a(bodies, 0), spike = part_of_a(bodies, 1);
  const dem_gpu::Pose as_it_is = Placed{}.pose();
  const dem_gpu::BodyFrames same(as_it_is, as_it_is, 4, 3);
  PartPair pair(boulder, spike, same.b_to_a);
  ASSERT_EQ(pair.classify_both(same), 0);
  Meeting met;
  int pieces = 0;
  EXPECT_TRUE(pair.visit(false, FaceSet::all(), met, [&](const Polygon&, int) { ++pieces; }));
  EXPECT_EQ(pieces, 1);
  const int base = face_along(spike, {0, 0, -1});
  for (int f = 0; f < 4; ++f) {
    EXPECT_EQ(met.reached.has(f), f != base);
    EXPECT_TRUE(pair.closing(true, met).has(f));
  }
  EXPECT_NEAR(bodies.volume({}, {}), 2 * 2.5 / 3 * (1 - 0.008), 1e-14 + kSingle.integral);
  EXPECT_NEAR(bodies.of<Integrals>({}, {}).area.z, 2 * 0.04, 1e-14 + kSingle.integral);
}

}  // namespace
