// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/assembly/part_builder.h"

#include <gtest/gtest.h>

#include "decomposition/assembly/face_kinds.h"
#include "tests/support/partition_checks.h"

namespace decomposition {
namespace {

TEST(PartBuilder, NudgedPointsNeverCross) {
  Random random(11);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Plane> planes;
    for (int k = 0; k < 3; ++k) planes.push_back({random.unit_vector(), random.uniform()});
    // Their common point, as well as doubles can hold it.
    const Vec3 bc = cross(planes[1].normal, planes[2].normal), ca = cross(planes[2].normal, planes[0].normal),
               ab = cross(planes[0].normal, planes[1].normal);
    const double determinant = dot(planes[0].normal, bc);
    if (std::abs(determinant) < 0.05) continue;
    const Vec3 p = (1 / determinant) * (planes[0].offset * bc + planes[1].offset * ca + planes[2].offset * ab);
    const Vec3 inside = p - (0.1 / determinant) * (bc + ca + ab);  // a tenth behind each
    const Vec3 moved = nudged_inside(p, planes, 1e-9, inside);
    for (const Plane& plane : planes) EXPECT_LE(exact_side(plane, moved), 0);
    EXPECT_LT(norm(moved - p), 1e-12 * (1 + norm(p)));
  }
}

// Cuts of a plate 1000 times as wide as thick lie at angles of a thousandth, on both sides of the point.
TEST(PartBuilder, NudgesBetweenPlanesAtTinyAngles) {
  const Vec3 p{0, 0, 0.3}, inside{1, -1, 0.3 - 1.5e-4};
  std::vector<Plane> planes;
  for (const Vec3& normal : {Vec3{1e-4, 0, 1}, Vec3{-1e-4, 1e-4, -1}, Vec3{0, -1e-4, 1}})
    planes.push_back({normalized(normal), dot(normalized(normal), p)});
  for (const Plane& plane : planes) ASSERT_LT(plane.signed_distance(inside), 0);
  const Vec3 moved = nudged_inside(p, planes, 1e-9, inside);
  for (const Plane& plane : planes) EXPECT_LE(exact_side(plane, moved), 0);
  EXPECT_LT(norm(moved - p), 1e-10);  // rounding over the angle
}

TEST(PartBuilder, PutsNearPointsOnTheCut) {
  const Plane cut{normalized({1, 2, 3}), 0.3};
  Vec3 u, v;
  plane_axes(cut.normal, u, v);
  const Vec3 o = cut.offset * cut.normal;
  // Four points a little behind the cut, four well behind it.
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i)
    points.push_back(o + (i & 1 ? 1.0 : -1.0) * u + (i & 2 ? 1.0 : -1.0) * v - (i & 4 ? 1.0 : 1e-3 * i) * cut.normal);
  const auto built = build_part(points, Cell{{cut}, {7}}, 0.01);
  ASSERT_TRUE(built);
  partition_checks::expect_sound_part(built->part, 8);
  EXPECT_EQ(built->part.face_count(), 6u);
  EXPECT_EQ(std::count(built->face_cut.begin(), built->face_cut.end(), 7), 1);
  EXPECT_NEAR(partition_checks::volume(built->part), 4, 1e-12);
}

TEST(FaceKinds, UncoveredRimIsCountedWhereNoVertexIsLeft) {
  // A box 2 x 2 x 1 under a box 1 x 1 x 1: a quarter of the lower one's top is covered.
  const Plane cut{{0, 0, 1}, 0};
  const auto box = [](double w, double low, double high) {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? w : 0, i & 2 ? w : 0, i & 4 ? high : low});
    return points;
  };
  const auto make = [&] {
    return std::vector<BuiltPart>{*build_part(box(2, -1, 0), Cell{{cut}, {0}}, 1e-6),
                                  *build_part(box(1, 0, 1), Cell{{cut.reversed()}, {0}}, 1e-6)};
  };
  std::vector<BuiltPart> capped = make();
  const CutCoverage tight = mark_faces(capped, {cut}, {8});
  EXPECT_NEAR(tight.covered_area, 1, 1e-12);
  EXPECT_NEAR(tight.ledge_area, 1, 1e-12);  // the lower top is mostly bare: outer, its covered area is the ledge
  std::vector<BuiltPart> roomy = make();
  const CutCoverage split = mark_faces(roomy, {cut}, {12});
  EXPECT_NEAR(split.ledge_area, 0, 1e-12);
  double inner = 0;
  for (const BuiltPart& built : roomy) {
    partition_checks::expect_sound_part(built.part, 12);
    for (const catalog::ConvexFace& face : built.part.faces)
      if (face.kind == catalog::FaceKind::inner) inner += partition_checks::face_area(built.part, face);
  }
  EXPECT_NEAR(inner, 2, 1e-12);  // 1 on either side
}

}  // namespace
}  // namespace decomposition
