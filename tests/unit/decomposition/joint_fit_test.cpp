// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/joint_fit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "decomposition/fit/bounds.h"
#include "decomposition/fit/joint_misfit.h"
#include "decomposition/fit/leaf_shape.h"
#include "decomposition/fit/part_rules.h"
#include "decomposition/fit/sections.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

constexpr double kTolerance = 1e-9;

/// A box [-1, 1]^3 cut by x = 0, then its left half by y = shift: three leaves that share two sections.
Partition cut_box(double shift = 0) {
  Partition partition;
  partition.cuts = {{Plane{{1, 0, 0}, 0}, {}}, {Plane{{0, 1, 0}, shift}, {CutSide{0, false}}}};
  partition.sections = {{0, {}, {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}}},
                        {1, {0}, {{-1, shift, -1}, {-1, shift, 1}}}};
  partition.leaves = {{{{0, true}}, {0}, {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}}, {}},
                      {{{0, false}, {1, false}}, {0, 1}, {{-1, -1, -1}, {-1, -1, 1}}, {}},
                      {{{0, false}, {1, true}}, {0, 1}, {{-1, 1, -1}, {-1, 1, 1}}, {}}};
  return partition;
}

std::vector<LeafShape> shapes_of(const Partition& partition) {
  SectionPolygons polygons;
  polygons.build(partition, kTolerance);
  std::vector<LeafShape> shapes(partition.leaves.size());
  for (std::size_t a = 0; a < shapes.size(); ++a)
    EXPECT_TRUE(shapes[a].update(partition, partition.leaves[a], polygons, 2));
  return shapes;
}

TEST(SectionPolygons, LaterSectionEndsOnTheEarlierOne) {
  const Partition partition = cut_box(0.25);
  SectionPolygons polygons;
  polygons.build(partition, kTolerance);
  EXPECT_EQ(polygons.polygon(0).size(), 4u);
  ASSERT_EQ(polygons.polygon(1).size(), 4u);
  int derived = 0;
  for (const int n : polygons.polygon(1)) {
    const SectionNode& node = polygons.nodes()[static_cast<std::size_t>(n)];
    EXPECT_DOUBLE_EQ(node.place.y, 0.25);
    if (node.is_free()) continue;
    ++derived;  // on the edges of the first section that the second cut meets, at 5/8 of their length
    EXPECT_DOUBLE_EQ(node.place.x, 0);
    EXPECT_DOUBLE_EQ(std::abs(node.place.z), 1);
    EXPECT_NEAR(std::abs(node.share - 0.5), 0.125, 1e-15);
  }
  EXPECT_EQ(derived, 2);
}

TEST(LeafShape, FacesOnCutsAreOnePolygonAndTheVolumesAddUp) {
  const std::vector<LeafShape> shapes = shapes_of(cut_box(0.25));
  double volume = 0;
  for (const LeafShape& shape : shapes) volume += shape.hull.volume();
  EXPECT_NEAR(volume, 8, 1e-4);  // the faces on cuts are bent by a millionth of the size
  const std::vector<std::vector<int>> faces = shapes[1].faces();
  const auto on_cuts = std::count_if(faces.begin(), faces.end(), [&](const std::vector<int>& face) {
    return face.size() == 4 && std::all_of(face.begin(), face.end(),
                                           [&](int v) { return shapes[1].on_cut[static_cast<std::size_t>(v)] != 0; });
  });
  EXPECT_EQ(on_cuts, 2);
  EXPECT_EQ(shapes[1].hull.vertex_count(), 8);
}

TEST(LeafShape, BothSidesOfACutHaveTheSameCorners) {
  const std::vector<LeafShape> shapes = shapes_of(cut_box(0.1));
  for (std::size_t v = shapes[1].own_count(); v < shapes[1].points.size(); ++v) {
    const Vec3& p = shapes[1].points[v];
    if (std::abs(p.y - 0.1) > kTolerance) continue;
    EXPECT_TRUE(std::any_of(shapes[2].points.begin(), shapes[2].points.end(),
                            [&](const Vec3& q) { return norm(p - q) < kTolerance; }));
  }
}

/// Two balls that overlap, along x, with the neck at x = 0.
catalog::TriangleMesh peanut() {
  return solids::star(
      [](const catalog::Point& d) {
        const double c = std::abs(d[0]);  // the farther of the balls' surfaces: centres at +-0.7, radius 1
        return 0.7 * c + std::sqrt(1 - 0.49 * (1 - c * c));
      },
      4);
}

Partition cut_peanut(const Solid& solid, double place) {
  Partition partition;
  partition.cuts = {{Plane{{1, 0, 0}, place}, {}}};
  Section section{0, {}, {}};
  for (int k = 0; k < 10; ++k) {
    const double angle = 2 * std::numbers::pi * k / 10;
    section.corners.push_back({place, 0.7 * std::cos(angle), 0.7 * std::sin(angle)});
  }
  partition.sections = {section};
  for (const bool is_reversed : {false, true}) {
    Leaf leaf{{{0, is_reversed}}, {0}, {}, {}};
    for (int k = 0; k < 40; ++k) {
      const Vec3 p = Vec3{is_reversed ? 0.9 : -0.9, 0, 0} + 0.8 * spread_direction(k, 40);
      if ((p.x > place + 0.1) == is_reversed && std::abs(p.x - place) > 0.1) leaf.points.push_back(p);
    }
    partition.leaves.push_back(leaf);
  }
  EXPECT_LT(joint_misfit(solid, partition), 0);
  return partition;
}

TEST(JointFit, CutMovesToTheNeckAndTheErrorFalls) {
  const Solid solid(peanut(), 3e5);
  Partition still = cut_peanut(solid, 0.3), moving = still;
  JointPlan plan;
  plan.volume = solid.volume();
  plan.cut_rate = 0;
  ASSERT_TRUE(fit_jointly(solid, still, plan));
  EXPECT_EQ(still.cuts[0].plane.offset, 0.3);
  plan.cut_rate = 0.5;
  ASSERT_TRUE(fit_jointly(solid, moving, plan));
  const Plane& plane = moving.cuts[0].plane;
  EXPECT_LT(std::abs(plane.offset), 0.1);
  EXPECT_GT(std::abs(plane.normal.x), 0.98);
  EXPECT_LT(joint_misfit(solid, moving), joint_misfit(solid, still) - 0.01 * solid.volume());
}

TEST(JointFit, SameSeedSamePoints) {
  const Solid solid(peanut(), 1e5);
  Partition one = cut_peanut(solid, 0.2), two = one;
  JointPlan plan;
  plan.steps = 50;
  ASSERT_TRUE(fit_jointly(solid, one, plan));
  ASSERT_TRUE(fit_jointly(solid, two, plan));
  for (std::size_t a = 0; a < one.leaves.size(); ++a)
    for (std::size_t v = 0; v < one.leaves[a].points.size(); ++v)
      EXPECT_EQ(norm(one.leaves[a].points[v] - two.leaves[a].points[v]), 0);
}

TEST(PartRules, TrimLeavesOutWhatMakesShortEdgesAndNarrowFaces) {
  const Solid solid(solids::box({-1, -1, -1}, {1, 1, 1}), 1e5);
  Partition partition = cut_box();
  partition.leaves[0].points.push_back({1.003, 0.99, 0.985});  // beside a corner
  partition.leaves[0].points.push_back({1.01, 0.0, 0.0});      // a pyramid on a face: as good as any
  partition.leaves[0].points.push_back({1.004, -0.98, 0.0});   // a narrow face along an edge
  PartRules rules;
  EXPECT_GT(count_flaws(solid, partition, rules), 0);
  const std::vector<int> lost = trim(solid, partition, rules, Trim::flaws);
  ASSERT_EQ(lost.size(), 3u);
  EXPECT_EQ(lost[0], 2);
  EXPECT_EQ(count_flaws(solid, partition, rules), 0);
}

TEST(PartRules, TrimHoldsBothCaps) {
  const Solid solid(solids::sphere(1, 3), 1e5);
  for (const int face_cap : {0, 20}) {
    Partition partition;
    partition.leaves.emplace_back();
    for (int k = 0; k < 40; ++k) partition.leaves[0].points.push_back(spread_direction(k, 40));
    PartRules rules;
    rules.vertices = 24;
    rules.faces = face_cap;
    const std::vector<int> lost = trim(solid, partition, rules, Trim::caps);
    ASSERT_EQ(lost.size(), 1u);
    // A hull of triangles has 2 V - 4 faces.
    EXPECT_EQ(partition.leaves[0].points.size(), face_cap == 0 ? 24u : 12u);
  }
}

TEST(PartRules, VolumeIsCorrected) {
  const Solid solid(solids::sphere(1, 3), 1e5);
  Partition partition;
  partition.leaves.emplace_back();
  for (int k = 0; k < 40; ++k) partition.leaves[0].points.push_back(spread_direction(k, 40));
  const double volume = shapes_of(partition)[0].hull.volume();
  correct_volume(solid, partition, 1.01 * volume);
  EXPECT_NEAR(shapes_of(partition)[0].hull.volume(), 1.01 * volume, 1e-5 * volume);
}

TEST(Bounds, PushesMakeABallHoldACubeAndStayInside) {
  const Solid solid(solids::voxels(
                        1, [](int, int, int) { return true; }, 6),
                    1e5);
  for (const Bound bound : {Bound::holds_solid, Bound::stays_inside}) {
    Partition partition;
    partition.leaves.emplace_back();
    for (int k = 0; k < 30; ++k)
      partition.leaves[0].points.push_back(Vec3{0.5, 0.5, 0.5} + 0.62 * spread_direction(k, 30));
    const BoundPoints points = bound_points(solid, partition, bound == Bound::holds_solid);
    double breach = 1;
    for (int push = 0; push < 400 && breach > -1e-7; ++push)
      breach = push_towards_bound(solid, partition, bound, points, 1e-6);
    EXPECT_LE(breach, -1e-7);
    const LeafShape shape = shapes_of(partition)[0];
    const bool holds = bound == Bound::holds_solid;
    for (const auto& triangle : shape.hull.faces()) {
      const auto at = [&](std::size_t k) { return shape.points[static_cast<std::size_t>(triangle[k])]; };
      const Vec3 normal = normalized(cross(at(1) - at(0), at(2) - at(0)));
      for (const Vec3& p : solid.vertices()) {
        if (!holds) continue;
        EXPECT_LT(dot(normal, p - at(0)), 0);
      }
    }
    EXPECT_GT(shape.hull.volume(), holds ? 1 : 0.3);
    EXPECT_LT(shape.hull.volume(), holds ? 3 : 1);
  }
}

}  // namespace
}  // namespace decomposition
