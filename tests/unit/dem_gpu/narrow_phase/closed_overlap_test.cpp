// SPDX-License-Identifier: Apache-2.0
// Overlaps from one part's surface alone, whose planes close it, against those from both parts' surfaces.
#include "dem_gpu/narrow_phase/closing_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tests/support/non_convex_bodies.h"
#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;
using catalog::ConvexPart;
using dem_gpu::ClosingPlanes;
using dem_gpu::FaceSet;
using dem_gpu::kLanes;
using dem_gpu::Mat3;
using dem_gpu::Meeting;
using dem_gpu::PartPair;
using dem_gpu::PartView;
using dem_gpu::Polygon;
using dem_gpu::SurfaceTriangles;
using Integrals = dem_gpu::VolumeIntegralsOf<dem_gpu::PatchSums>;

/// Of a coordinate, over the size of the bodies: some roundings.
constexpr Real kRounding = 1e-15 + kSingle.position;

/// How much further an edge moves than a face that it lies in, of hulls with faces that are nearly parallel.
constexpr Real kSlanted = 300;

/// Counts the pairs of parts that one surface is enough for.
struct CountedIntegrals : Integrals {
  int closed_a = 0, closed_b = 0;  // by whose surface it is

  bool add_closed(const SurfaceTriangles& surface, bool is_of_b, const ClosingPlanes& planes) {
    const bool is_added = Integrals::add_closed(surface, is_of_b, planes);
    (is_of_b ? closed_b : closed_a) += is_added;
    return is_added;
  }
};

/// By all of both parts' surfaces.
struct BothSurfaces {
  Integrals integrals;
  Real area = 0;    // of both surfaces, those of cuts too [m2]
  Real extent = 0;  // of the overlap, from the point of reference [m]

  void add(const PartPair& pair, bool is_of_b) {
    SurfaceTriangles triangles;
    const auto hand_on = [&] {
      if (triangles.is_empty()) return;
      triangles.fill_up();
      if (!is_of_b) triangles.move(pair.b_to_a);
      integrals.add_surface(triangles, is_of_b);
      measure(triangles);
      triangles.clear();
    };
    const int outer_count = pair.surface(is_of_b).range.outer_face_count;
    Meeting unused;
    EXPECT_TRUE(pair.visit(is_of_b, FaceSet::all(), unused, [&](const Polygon& polygon, int face) {
      if (triangles.add(polygon, face < outer_count)) return;
      hand_on();
      EXPECT_TRUE(triangles.add(polygon, face < outer_count));
    }));
    hand_on();
  }

 private:
  void measure(const SurfaceTriangles& triangles) {
    for (int block = 0; block < triangles.block_count(); ++block)
      for (int lane = 0; lane < kLanes; ++lane) {
        const auto corner = [&](int c) -> Vec3 { return point_at(triangles.corners(c, block), lane); };
        area += norm(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
        for (int c = 0; c < 3; ++c) extent = std::max(extent, norm(corner(c) - integrals.reference));
      }
  }
};

/// Two bodies and where they stand.
struct Pair {
  Parts parts_a, parts_b;
  Placed a, b;

  Pair swapped() const { return {parts_b, parts_a, b, a}; }
};

BothSurfaces from_both_surfaces(const PairIntegrals& bodies, const Placed& a, const Placed& b) {
  const dem_gpu::ShapeView shapes = view(bodies.columns());
  const dem_gpu::ShapeRange &range_a = shapes.shapes[0], &range_b = shapes.shapes[1];
  const dem_gpu::Pose pose_a = a.pose(), pose_b = b.pose();
  const dem_gpu::BodyFrames frames(pose_a, pose_b, range_a.bounding_radius, range_b.bounding_radius);
  BothSurfaces sums;
  for (int j = 0; j < range_b.part_count; ++j)
    for (int i = 0; i < range_a.part_count; ++i) {
      const PartView part_a = part_view(shapes, range_a.first_part + i);
      const PartView part_b = part_view(shapes, range_b.first_part + j);
      PartPair pair(part_a, part_b, frames.b_to_a);
      if (pair.classify_both(frames) != 0) continue;
      sums.add(pair, true);
      sums.add(pair, false);
    }
  return sums;
}

Real greatest_difference(const Mat3& a, const Mat3& b) {
  const Mat3 d = dem_gpu::weighted_sum(1, a, -1, b);
  return std::max({norm(d.column_x), norm(d.column_y), norm(d.column_z)});
}
Mat3 about_centroid(const Integrals& integrals) {
  Mat3 sum = integrals.second_moment;
  add_outer_product(sum, -1 / integrals.volume, integrals.first_moment);
  return sum;
}

/// Which surfaces were enough, in how many of the pairs of parts.
struct Taken {
  int of_a = 0, of_b = 0;
};

void expect_same(const Pair& pair, const char* name, Taken& taken) {
  SCOPED_TRACE(name);
  const PairIntegrals bodies(pair.parts_a, pair.parts_b);
  const BothSurfaces both = from_both_surfaces(bodies, pair.a, pair.b);
  const Integrals& expected = both.integrals;
  CountedIntegrals start;
  start.reference = expected.reference;
  start.has_reference = expected.has_reference;
  const CountedIntegrals got = bodies.of(pair.a, pair.b, false, start);
  taken.of_a += got.closed_a, taken.of_b += got.closed_b;
  if (got.closed_a + got.closed_b == 0) return;

  const Real reach = bodies.columns().shapes[0].bounding_radius;
  const Real size = reach + pair.b.scale / pair.a.scale * bodies.columns().shapes[1].bounding_radius;
  const Real shift = kRounding * size, area = both.area, d = both.extent;
  EXPECT_NEAR(got.volume, expected.volume, 5 * shift * area);
  EXPECT_LE(norm(got.area - expected.area), kSlanted * shift * d);
  EXPECT_LE(norm(got.area_moment - expected.area_moment), kSlanted * shift * d * reach);
  EXPECT_LE(norm(got.first_moment - expected.first_moment), 5 * shift * area * d);
  EXPECT_LE(greatest_difference(got.second_moment, expected.second_moment), 10 * shift * area * d * d);

  const dem_gpu::Mat3 upright = rotation_matrix(dem_gpu::Quaternion{});
  const dem_gpu::AreaPatchSums &patch = got.patch, &other = expected.patch;
  for (const auto& [side, other_side] :
       {std::pair(patch.side_a, other.side_a), std::pair(patch.side_b, other.side_b)}) {
    EXPECT_NEAR(side.weight, other_side.weight, kSlanted * shift * d);
    EXPECT_LE(norm(side.total - other_side.total), kSlanted * shift * d);
  }
  EXPECT_NEAR(patch.weight, other.weight, kSlanted * shift * d);
  EXPECT_LE(norm(patch.first_moment - other.first_moment), kSlanted * shift * d * size);
  EXPECT_NEAR(patch.second_moment, other.second_moment, kSlanted * shift * d * size * size);
  const auto square = [](Real x) { return x * x; };
  if (other.weight > 0) {
    EXPECT_NEAR(square(patch.lever()), square(other.lever()), kSlanted * shift * d * size * size / other.weight);
  }
  // One side's where that is a cut, or closed in itself: rounding.
  const Real least_total = std::min(norm(other.side_a.total), norm(other.side_b.total));
  EXPECT_LE(greatest_difference(patch.normals(upright), other.normals(upright)), 5 * shift * d / least_total);

  // About its own point of reference.
  const Integrals own = bodies.of<Integrals>(pair.a, pair.b);
  EXPECT_NEAR(own.volume, expected.volume, 5 * shift * area);
  EXPECT_LE(norm(own.centroid() - expected.centroid()), 5 * shift * area * d / expected.volume);
  EXPECT_LE(greatest_difference(about_centroid(own), about_centroid(expected)), 10 * shift * area * d * d);
}

Real uniform(std::mt19937& random, Real low, Real high) {
  return std::uniform_real_distribution<Real>(low, high)(random);
}
ConvexPart random_part(std::mt19937& random) {
  switch (random() % 5) {
    case 0:
      return unit_cube();
    case 1:
      return tetrahedron(1.5);
    case 2:
      return octahedron(0.8);
    default:
      return random_convex_part(random, 4 + static_cast<int>(random() % 9), {1, 1, random() % 2 ? 1 : 0.3});
  }
}
/// Of one part, or of several with cuts between, and flat sides of several faces.
Parts random_body(std::mt19937& random) {
  switch (random() % 6) {
    case 0:
      return cut_box({1, 1, 1}, {2, 1, 2});
    case 1:
      return l_in_2();
    case 2:
      return l_in_3();
    default:
      return {random_part(random)};
  }
}

/// Anyhow through one another.
Pair deep_pair(std::mt19937& random) {
  Pair pair{{random_part(random)}, {random_part(random)}, {3 * random_direction(random), random_rotation(random)}, {}};
  pair.b = {pair.a.position + uniform(random, 0, 1) * random_direction(random), random_rotation(random),
            std::pow(10, uniform(random, -1, 1))};
  return pair;
}

/// The vertex of b that is the lowest as seen from a face of a, somewhere below that.
Pair shallow_pair(std::mt19937& random) {
  Pair pair{random_body(random), random_body(random), {3 * random_direction(random), random_rotation(random)}, {}};
  pair.b = {{}, random_rotation(random), std::pow(10, uniform(random, -1, 1))};
  const ConvexPart& part = pair.parts_a[random() % pair.parts_a.size()];
  const catalog::ConvexFace& face = part.faces[random() % part.faces.size()];
  const Vec3 normal = rotate(pair.a.orientation, to_vec3(face.plane.normal));
  Vec3 lowest, point;
  Real lowest_height = std::numeric_limits<Real>::max(), weights = 0;
  for (const ConvexPart& part_b : pair.parts_b)
    for (const catalog::Point& vertex : part_b.vertices) {
      const Vec3 x = pair.b.scale * rotate(pair.b.orientation, to_vec3(vertex));
      if (dot(x, normal) < lowest_height) lowest_height = dot(x, normal), lowest = x;
    }
  for (const int v : face.vertices) {
    const Real weight = uniform(random, 0, 1);
    point += weight * to_vec3(part.vertices[static_cast<std::size_t>(v)]), weights += weight;
  }
  const Real depth = pair.b.scale * std::pow(10, -uniform(random, 0, kIsMixed ? 3 : 6));
  pair.b.position = pair.a.position + rotate(pair.a.orientation, point / weights) - depth * normal - lowest;
  return random() % 2 ? pair.swapped() : pair;
}

/// Corners and edges of one in planes of the other, but for noise.
Pair lattice_pair(std::mt19937& random, Real noise) {
  const auto body = [&]() -> Parts {
    const auto kind = random() % 6;
    if (kind == 0) return {tetrahedron(1, random() % 2)};
    if (kind == 1) return {octahedron(1)};
    if (kind == 2) return {unit_cube()};
    return random_body(random);
  };
  const auto quarter_turns = [&](const Vec3& axis) {
    return dem_gpu::axis_angle(axis, static_cast<Real>(random() % 4) * std::numbers::pi / 2);
  };
  const auto step = [&] { return 0.25 * static_cast<Real>(static_cast<int>(random() % 7) - 3); };
  Pair pair{body(), body(), {}, {{step(), step(), step()}, quarter_turns({1, 0, 0}) * quarter_turns({0, 1, 0})}};
  pair.b.position += noise * random_direction(random);
  if (random() % 2) pair.b.scale = 2;
  if (random() % 4 == 0) pair.b.orientation = pair.b.orientation * dem_gpu::axis_angle({0, 0, 1}, std::numbers::pi / 4);
  pair.b.orientation = pair.b.orientation * dem_gpu::axis_angle(random_direction(random), noise);
  return pair;
}

TEST(ClosedOverlap, IsThatOfBothSurfaces) {
  std::mt19937 random(1);
  Taken deep, shallow;
  for (int i = 0; i < 2000; ++i) expect_same(deep_pair(random), "deep", deep);
  for (int i = 0; i < 2000; ++i) expect_same(shallow_pair(random), "shallow", shallow);
  EXPECT_GT(deep.of_a, 30);
  EXPECT_GT(deep.of_b, 100);
  EXPECT_GT(shallow.of_a, 300);
  EXPECT_GT(shallow.of_b, 600);
}

TEST(ClosedOverlap, IsThatOfBothSurfacesWhereCornersAndEdgesLieInPlanes) {
  // In tilts from 1e-7 on the two surfaces no longer meet to rounding: their edges are cut rounding / tilt apart.
  std::mt19937 random(2);
  Taken taken;
  for (const Real noise : {0., 1e-16, 1e-14, 1e-12, 1e-10, 1e-8})
    for (int i = 0; i < 500; ++i) expect_same(lattice_pair(random, noise), "lattice", taken);
  EXPECT_GT(taken.of_a, 200);
  EXPECT_GT(taken.of_b, 300);
}

/// Two pyramids of height 1 base to base, that in z = 0.
ConvexPart bipyramid(int sides, bool is_upper_first) {
  std::vector<Vec3> vertices;
  for (int i = 0; i < sides; ++i) {
    const Real angle = 2 * std::numbers::pi * i / sides;
    vertices.push_back({std::cos(angle), std::sin(angle), 0});
  }
  vertices.insert(vertices.end(), {{0, 0, 1}, {0, 0, -1}});
  std::vector<std::vector<int>> loops;
  for (const bool is_upper : {is_upper_first, !is_upper_first})
    for (int i = 0; i < sides; ++i) {
      const int next = (i + 1) % sides;
      loops.push_back(is_upper ? std::vector{i, next, sides} : std::vector{next, i, sides + 1});
    }
  return part_of(vertices, loops);
}

TEST(ClosedOverlap, EdgesAllAroundLieInThePlaneThatClosesIt) {
  // Whether the faces below them are cut is up to rounding; they come eight at a time, with those above or without.
  const Real step = kIsMixed ? 1e6 : 1;
  int closed = 0;
  for (int sides = 3; sides < 16; ++sides)
    for (const bool is_upper_first : {false, true}) {
      const PairIntegrals bodies({dem_gpu::box_part({4, 4, 4})}, {bipyramid(sides, is_upper_first)});
      const Real half = sides * std::sin(2 * std::numbers::pi / sides) / 6;
      for (const Real tilt : {0., 1e-16, 1e-14, 1e-12, 1e-10, 1e-8})
        for (const Real offset : {0., 1e-16, -1e-16, 1e-14, -1e-14, 1e-12, -1e-12, 1e-10, -1e-10, 1e-8, -1e-8}) {
          const Quaternion turn = dem_gpu::axis_angle({0, 0, 1}, 0.3) * Quaternion{1, step * tilt, step * tilt / 3, 0};
          const Placed b{{0.1, 0.2, 2 + step * offset}, dem_gpu::normalized(turn)};
          const auto overlap = bodies.of<CountedIntegrals>({}, b);
          const Real tolerance = 12 * step * (tilt + std::abs(offset)) + 1e-14 + kSingle.integral;
          EXPECT_NEAR(overlap.volume, half, tolerance) << sides;
          EXPECT_NEAR(overlap.area.z, 3 * half, tolerance) << sides;
          closed += overlap.closed_a + overlap.closed_b;
        }
    }
  EXPECT_GT(closed, 300);
}

/// Between two triangles one above the other, by the distances of their corners from the axis.
ConvexPart frustum(Real bottom, Real radius_at_bottom, Real top, Real radius_at_top) {
  std::vector<Vec3> vertices;
  for (int i = 0; i < 6; ++i) {
    const Real angle = 2 * std::numbers::pi * i / 3, r = i < 3 ? radius_at_bottom : radius_at_top;
    vertices.push_back({r * std::cos(angle), r * std::sin(angle), i < 3 ? bottom : top});
  }
  return part_of(vertices, {{2, 1, 0}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}});
}

TEST(ClosedOverlap, APlateAboutASpikeIsSeenFromTheSpikesTip) {
  std::mt19937 random(4);
  for (const Real slope : {0.04, 0.1, 0.5})  // of the spike's faces; its tip lies 1 / slope below, where it has none
    for (const Real thickness : {0.1, 0.01}) {
      const PairIntegrals bodies({frustum(-0.99 / slope, 0.02, 0, 2)},
                                 {frustum(-thickness / 2, 20, thickness / 2, 20)});
      const Quaternion turn = random_rotation(random);
      const Real height = uniform(random, 0.5, 0.9) / slope;  // above the tip
      const auto overlap = bodies.of<CountedIntegrals>({{}, turn}, {rotate(turn, {0, 0, height - 1 / slope}), turn});
      if (!kIsMixed) {  // there a plate so thin is cut from both sides
        EXPECT_EQ(overlap.closed_b, 1);
      }
      // Of the square of the height over the plate, about its middle.
      const Real t2 = thickness * thickness, mean_square = height * height + t2 / 12;
      const Real volume = 3 * std::sqrt(3.0) * slope * slope * thickness * mean_square;
      const Real centre = height * t2 / 6 / mean_square;
      const Real variance = (height * height * t2 / 12 + t2 * t2 / 80) / mean_square - centre * centre;
      const Real rounding = 200 * kRounding / thickness;
      EXPECT_NEAR(overlap.volume / volume, 1, rounding);
      EXPECT_LE(norm(overlap.centroid() - Vec3{0, 0, height - 1 / slope + centre}), rounding / slope);
      EXPECT_NEAR(about_centroid(overlap).column_z.z / overlap.volume, variance, rounding / (slope * slope));
    }
}

TEST(ClosedOverlap, AFlatSideMayBeFoldedByAHair) {
  // Two faces that count as one plane, the second wholly inside: the first one's plane misses the corner between the
  // second and the sides.
  const Real fold = kIsMixed ? 7e-6 : 7e-10, cut = 1.8, thin = 0.01;
  const std::vector<Vec3> vertices{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2 * thin}, {1, 0, -fold}, {0, 1, -fold}};
  const std::vector<std::vector<int>> sides{{0, 4, 1, 3}, {0, 3, 2, 5}, {1, 2, 3}};
  const Vec3 middle{cut / 3, cut / 3, thin * cut / 3}, normal{1, 1, 1 / thin};
  const Vec3 along = dem_gpu::any_perpendicular(normal) / norm(dem_gpu::any_perpendicular(normal));
  const Vec3 across = cross(normal, along) / norm(normal);
  const ConvexPart cutter = hull_of({middle + 6 * along, middle - 3 * along + 5 * across,
                                     middle - 3 * along - 5 * across, middle - 4 * normal / norm(normal)});
  for (const bool is_covered_first : {false, true}) {
    std::vector<std::vector<int>> loops{{4, 5, 2, 1}, {0, 5, 4}};
    if (is_covered_first) std::swap(loops[0], loops[1]);
    loops.insert(loops.end(), sides.begin(), sides.end());
    const PairIntegrals bodies({cutter}, {part_of(vertices, loops)});
    const Real both = from_both_surfaces(bodies, {}, {}).integrals.volume;
    EXPECT_NEAR(bodies.of<CountedIntegrals>({}, {}).volume / both, 1, 1e-12 + kSingle.relative);
  }
}

}  // namespace
