// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/parts/rock_bed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "workflows/bench/bench_shapes.h"

namespace {

using namespace workflows;

constexpr BedSize kSmall{36, 7, 3};
constexpr double kReach = 0.71;  // of a cube: half its diagonal over the diameter of the sphere of its volume [-]

dem_gpu::Shape cube() { return dem_gpu::polyhedral_shape("cube", {dem_gpu::box_part({1, 1, 1})}); }

TEST(RockBed, ComesToRestInsideTheBoxAndIsTheSameAgain) {
  const PouredBed bed = pour_bed(cube(), kReach, 1, kSmall);
  ASSERT_EQ(bed.bodies.size(), 36u);
  const double half_edge = std::cbrt(std::numbers::pi / 6) * kRockDiameter / 2;
  double fastest = 0;
  for (const dem_gpu::Body& rock : bed.bodies) {
    // A cube's centre is at least half an edge from a wall, less the overlap.
    EXPECT_GT(rock.position.z, 0.9 * half_edge);
    EXPECT_GT(rock.position.x, 0.9 * half_edge);
    EXPECT_LT(rock.position.x, kSmall.length * kRockDiameter - 0.9 * half_edge);
    EXPECT_LT(rock.position.z, 5 * kRockDiameter);
    fastest = std::max(fastest, norm(rock.velocity));
  }
  EXPECT_LT(fastest, 0.15) << "of 0.8 m/s that a fall of two diameters gives";
  EXPECT_GT(bed.packing_fraction, 0.35);
  EXPECT_LT(bed.packing_fraction, 1);
  EXPECT_GT(bed.contacts, 2) << "each rock is held";
  EXPECT_LT(std::abs(bed.imbalance), 0.01) << "what the preset draft promises";
  const PouredBed again = pour_bed(cube(), kReach, 1, kSmall), other = pour_bed(cube(), kReach, 2, kSmall);
  EXPECT_EQ(again.packing_fraction, bed.packing_fraction);
  EXPECT_NE(other.packing_fraction, bed.packing_fraction);
}

TEST(RockBed, SlidesWhenTiltedAndLeavesThroughTheOpening) {
  const PouredBed bed = pour_bed(cube(), kReach, 1, kSmall);
  const double angle = slide_angle(cube(), bed);
  // Not before the friction angle of 26.6 degrees, and within the 60 degrees that the tilt reaches.
  EXPECT_GT(angle, 20);
  EXPECT_LT(angle, kFirstTilt + kTiltRate * kTiltTime);
  const EmptiedBed emptied = empty_bed(cube(), bed);
  // Free fall by the height at which rocks are counted out, 1.5 diameters, takes 0.078 s.
  EXPECT_GT(emptied.half_time, 0.078);
  EXPECT_GE(emptied.left, 0.1) << "half of the floor stays";
  EXPECT_LE(emptied.left, 0.5);
}

}  // namespace
