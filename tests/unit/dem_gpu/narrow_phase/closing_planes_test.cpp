// SPDX-License-Identifier: Apache-2.0
// Overlaps from one part's surface alone, whose planes close it, against those from both parts' surfaces.
#include "dem_gpu/narrow_phase/closing_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
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
using dem_gpu::FrameChange;
using dem_gpu::kLanes;
using dem_gpu::LocalReal;
using dem_gpu::LocalVec3;
using dem_gpu::Mat3;
using dem_gpu::Meeting;
using dem_gpu::PartPair;
using dem_gpu::PartView;
using dem_gpu::PatchSide;
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

  const dem_gpu::PatchSums &patch = got.patch, &other = expected.patch;
  for (const auto& [side, other_side] :
       {std::pair(patch.side_a, other.side_a), std::pair(patch.side_b, other.side_b)}) {
    EXPECT_NEAR(side.weight, other_side.weight, kSlanted * shift * d);
    EXPECT_LE(norm(side.total - other_side.total), kSlanted * shift * d);
    EXPECT_LE(norm(side.pointed - other_side.pointed), kSlanted * shift * d);
    EXPECT_EQ(side.aligned, 0);
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
  EXPECT_LE(greatest_difference(patch.normals(), other.normals()), 5 * shift * d / least_total);

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

Polygon regular_polygon(int corners, Real height) {
  LocalVec3 points[kLanes];
  LocalReal x[kLanes], y[kLanes], z[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const Real angle = 2 * std::numbers::pi * (i < corners ? i : 0) / corners;
    points[i] = dem_gpu::rounded(Vec3{std::cos(angle), std::sin(angle), height});
    x[i] = points[i].x, y[i] = points[i].y, z[i] = points[i].z;
  }
  return {dem_gpu::load_points(x, y, z), corners};
}
Real area_of(int corners) { return corners * std::sin(2 * std::numbers::pi / corners) / 2; }

struct Areas {
  Vec3 all, outer;
  Real unsigned_sum = 0;
};
Areas areas_of(const SurfaceTriangles& triangles) {
  Areas sums;
  for (int block = 0; block < triangles.block_count(); ++block)
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto corner = [&](int c) -> Vec3 { return point_at(triangles.corners(c, block), lane); };
      const Vec3 area = 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0));
      sums.all += area;
      sums.outer += triangles.outer(block)[lane] * area;
      sums.unsigned_sum += norm(area);
    }
  return sums;
}

TEST(SurfaceTriangles, HoldTheAreaOfTheirPolygons) {
  SurfaceTriangles triangles;
  EXPECT_TRUE(triangles.is_empty());
  Real all = 0, outer = 0;
  int count = 0;
  for (int corners = 1; corners <= kLanes; ++corners) {
    const bool is_outer = corners % 2 != 0;
    EXPECT_TRUE(triangles.add(regular_polygon(corners, corners), is_outer));
    EXPECT_EQ(triangles.is_empty(), corners < 3);
    if (corners < 3) continue;
    count += corners - 2;
    all += area_of(corners);
    outer += is_outer ? area_of(corners) : 0;
    SurfaceTriangles filled = triangles;
    filled.fill_up();
    EXPECT_EQ(filled.block_count(), (count + kLanes - 1) / kLanes);
    const Areas areas = areas_of(filled);
    EXPECT_NEAR(areas.all.z, all, 1e-14 + kSingle.integral);
    EXPECT_NEAR(areas.unsigned_sum, all, 1e-14 + kSingle.integral);
    EXPECT_NEAR(areas.outer.z, outer, 1e-14 + kSingle.integral);
  }
  EXPECT_EQ(triangles.point(2).z, 3);
  const FrameChange change{rotation_matrix(edge_down()), {1, 2, 3}, 2};
  SurfaceTriangles moved = triangles;
  moved.fill_up();
  moved.move(change);
  EXPECT_LE(norm(areas_of(moved).all - 4 * all * change.direction({0, 0, 1})), 1e-13 + 100 * kSingle.integral);
  EXPECT_LE(norm(Vec3(moved.point(1)) - change.point(triangles.point(1))), 1e-14 + 10 * kSingle.position);
  triangles.clear();
  EXPECT_TRUE(triangles.is_empty());
}

TEST(SurfaceTriangles, AreFull) {
  for (const int corners : {3, 5, 8}) {
    SurfaceTriangles triangles;
    const int room = SurfaceTriangles::kMost / (corners - 2);
    for (int i = 0; i < room; ++i) EXPECT_TRUE(triangles.add(regular_polygon(corners, 0), true));
    EXPECT_FALSE(triangles.add(regular_polygon(kLanes, 0), true));
    EXPECT_EQ(triangles.add(regular_polygon(2, 0), true), true) << "an edge has no area";
    triangles.fill_up();
    EXPECT_NEAR(areas_of(triangles).all.z, room * area_of(corners), 1e-12 + 100 * kSingle.integral);
  }
}

}  // namespace
