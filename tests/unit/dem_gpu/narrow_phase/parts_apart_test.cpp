// SPDX-License-Identifier: Apache-2.0
// The distance of two parts against that of all their edges and of their vertices from each other's faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "dem_gpu/narrow_phase/closest_point.h"
#include "dem_gpu/narrow_phase/parts_apart.h"
#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;
using dem_gpu::FrameChange;
using dem_gpu::PartView;

struct Edge {
  Vec3 from, to;
};

std::vector<Edge> edges_of(const PartView& part, const FrameChange& to_frame) {
  std::vector<Edge> edges;
  for (int f = 0; f < part.range.face_count; ++f) {
    const dem_gpu::FaceCorners& face = part.faces[f];
    for (int c = 0; c < face.count; ++c) {
      const Vec3 from = part.vertices[part.corners[face.first + c]];
      const Vec3 to = part.vertices[part.corners[face.first + (c + 1) % face.count]];
      if (part.corners[face.first + c] < part.corners[face.first + (c + 1) % face.count])  // each edge once
        edges.push_back({to_frame.point(from), to_frame.point(to)});
    }
  }
  return edges;
}

/// Least distance of two segments, by halving the range of the place on the first: the distance from a point to a
/// segment is convex.
Real distance_of(const Edge& a, const Edge& b) {
  const auto at = [&](Real share) {
    const Vec3 x = a.from + share * (a.to - a.from);
    return norm(x - dem_gpu::closest_on_segment(b.from, b.to, x));
  };
  Real low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const Real third = (high - low) / 3;
    (at(low + third) < at(high - third) ? high : low) += at(low + third) < at(high - third) ? -third : third;
  }
  return at((low + high) / 2);
}

/// Of two parts that do not overlap.
Real true_distance(const PartView& a, const PartView& b, const FrameChange& b_to_a, const FrameChange& a_to_b) {
  Real least = 1e300;
  for (const Edge& of_a : edges_of(a, {{}, {}, 1}))
    for (const Edge& of_b : edges_of(b, b_to_a)) least = std::min(least, distance_of(of_a, of_b));
  for (int v = 0; v < b.range.vertex_count; ++v)
    least = std::min(least, distance_to_part(a, b_to_a.point(b.vertices[v]), 100).distance);
  for (int v = 0; v < a.range.vertex_count; ++v)
    least = std::min(least, b_to_a.scale * distance_to_part(b, a_to_b.point(a.vertices[v]), 100).distance);
  return least;
}

TEST(DistanceApart, IsAtMostTheDistanceAndMostOfIt) {
  std::mt19937 random(41);
  int apart = 0, edge_on_edge = 0;
  for (int i = 0; i < 20; ++i) {
    const PairIntegrals pair({random_convex_part(random, 6 + i % 20)}, {random_convex_part(random, 12, {1, 0.6, 0.4})});
    const dem_gpu::ShapeView shapes = view(pair.columns());
    const PartView a = part_view(shapes, 0), b = part_view(shapes, 1);
    for (int k = 0; k < 15; ++k) {
      const Placed at_b{(1.1 + 0.07 * k) * random_direction(random), random_rotation(random), k % 3 == 0 ? 0.5 : 1};
      const dem_gpu::Pose pose_a = Placed{}.pose(), pose_b = at_b.pose();
      const FrameChange b_to_a = frame_change(pose_a, pose_b), a_to_b = frame_change(pose_b, pose_a);
      const Real found = distance_apart(a, b, b_to_a);
      if (pair.volume({}, at_b) > 0) {
        EXPECT_EQ(found, 0) << "they overlap";
        continue;
      }
      const Real distance = true_distance(a, b, b_to_a, a_to_b);
      EXPECT_LE(found, distance + 1e-9 + kSingle.position);
      EXPECT_GE(found, 0.8 * distance - 1e-9 - kSingle.position);
      ++apart;
      bool is_by_face = false;
      for (int f = 0; f < a.range.face_count; ++f) is_by_face |= distance_outside(b, a.planes[f], b_to_a) > 0;
      for (int f = 0; f < b.range.face_count; ++f) is_by_face |= distance_outside(a, b.planes[f], a_to_b) > 0;
      edge_on_edge += !is_by_face;
    }
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(edge_on_edge, 2) << "pairs that no face plane separates";
}

TEST(DistanceApart, OfBodiesIsThatOfTheirNearestParts) {
  std::mt19937 random(43);
  const PairIntegrals whole({unit_cube()}, {unit_cube()}),
      parts(cut_box({1, 1, 1}, {2, 2, 1}), cut_box({1, 1, 1}, {1, 2, 2}));
  const auto of = [](const PairIntegrals& pair, const Placed& a, const Placed& b) {
    return dem_gpu::distance_of_bodies(view(pair.columns()), 0, 1, a.pose(), b.pose());
  };
  for (int i = 0; i < 100; ++i) {
    const Placed a{random_direction(random), random_rotation(random)};
    const Placed b{a.position + (1.2 + 0.01 * i) * random_direction(random), random_rotation(random)};
    const Real one = of(whole, a, b), many = of(parts, a, b);
    if (one > 0)
      EXPECT_NEAR(many / one, 1, 0.26) << "each is 0.8 to 1 of the distance";
    else
      EXPECT_LE(many, 1e-9 + kSingle.position);
  }
  EXPECT_NEAR(of(whole, {}, {{3, 0, 0}, {}}), 2, 20 * dem_gpu::kCoplanarity) << "less what rounding may be";
}

}  // namespace
