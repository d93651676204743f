// SPDX-License-Identifier: Apache-2.0
// The canonical depth field of non-convex bodies: against brute-force distance, across cuts, and for two cuts of one
// body.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <numbers>

#include "dem_gpu/shapes/depth_field.h"
#include "tests/support/non_convex_bodies.h"

namespace {

using namespace test_support;
using dem_gpu::PartDepthField;

constexpr Real kCap = 0.4;  // below half the thickness of most limbs: both cap and surface decide somewhere
constexpr Real kSize = 2;   // scale of tolerances

struct Body {
  Parts parts;
  std::vector<PartDepthField> fields;
  explicit Body(Parts from, Real cap = kCap)
      : parts(std::move(from)), fields(dem_gpu::part_depth_fields(parts, kSize, cap)) {}

  Real depth_in(std::size_t part, const Vec3& x, Real cap = kCap) const {
    Real least = cap;
    for (const auto& plane : fields[part].planes) least = std::min(least, dem_gpu::depth_below(plane, x));
    for (const auto& term : fields[part].greatest) least = std::min(least, dem_gpu::greatest_depth(term, x));
    return least;
  }
  /// Highest of the heights over the part's planes: not positive inside.
  Real height_over(std::size_t part, const Vec3& x) const {
    Real height = -1e300;
    for (const auto& face : parts[part].faces)
      height = std::max(height, dot(to_vec3(face.plane.normal), x) - face.plane.offset);
    return height;
  }
  std::size_t part_of(const Vec3& x) const {
    std::size_t best = 0;
    for (std::size_t p = 1; p < parts.size(); ++p)
      if (height_over(p, x) < height_over(best, x)) best = p;
    return best;
  }
};

Real distance_to_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Real share = std::clamp(dot(x - a, b - a) / norm_squared(b - a), Real(0), Real(1));
  return norm(x - a - share * (b - a));
}

/// Euclidean distance to the outer polygons, each tried.
Real distance_to_surface(const Body& body, const Vec3& x) {
  Real nearest = 1e300;
  for (const auto& part : body.parts)
    for (const auto& face : part.faces) {
      if (face.kind != catalog::FaceKind::outer) continue;
      const Vec3 normal = to_vec3(face.plane.normal);
      const Real height = dot(normal, x) - face.plane.offset;
      bool is_above = true;
      for (std::size_t c = 0; c < face.vertices.size(); ++c) {
        const Vec3 p = to_vec3(part.vertices[static_cast<std::size_t>(face.vertices[c])]);
        const Vec3 q = to_vec3(part.vertices[static_cast<std::size_t>(face.vertices[(c + 1) % face.vertices.size()])]);
        if (dot(cross(q - p, x - p), normal) < 0) is_above = false;
        nearest = std::min(nearest, distance_to_segment(p, q, x));
      }
      if (is_above) nearest = std::min(nearest, std::abs(height));
    }
  return nearest;
}

/// A random point of a convex part or face: a random mean of its vertices.
Vec3 random_mean(std::mt19937& random, const catalog::ConvexPart& part, const std::vector<int>& vertices) {
  std::exponential_distribution<Real> weight;
  Vec3 sum;
  Real total = 0;
  for (const int vertex : vertices) {
    const Real w = weight(random);
    sum += w * to_vec3(part.vertices[static_cast<std::size_t>(vertex)]);
    total += w;
  }
  return sum / total;
}

std::vector<int> all_vertices(const catalog::ConvexPart& part) {
  std::vector<int> all(part.vertices.size());
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<int>(v);
  return all;
}

struct Ratio {
  Real least = 1e300, largest = 0;
};

Ratio check_field(const char* name, const Body& body, int samples) {
  std::mt19937 random(31);
  Ratio ratio;
  Real on_surface = 0, across_cuts = 0;
  std::size_t terms = 0, planes = 0;
  for (std::size_t p = 0; p < body.parts.size(); ++p) {
    const catalog::ConvexPart& part = body.parts[p];
    planes += body.fields[p].planes.size();
    terms += body.fields[p].greatest.size();
    for (const auto& face : part.faces)
      for (int i = 0; i < samples / 4; ++i) {
        const Vec3 x = random_mean(random, part, face.vertices);
        if (face.kind == catalog::FaceKind::outer) {
          on_surface = std::max(on_surface, std::abs(body.depth_in(p, x)));
          continue;
        }
        for (std::size_t q = 0; q < body.parts.size(); ++q)
          if (body.height_over(q, x) < 1e-12)
            across_cuts = std::max(across_cuts, std::abs(body.depth_in(p, x) - body.depth_in(q, x)));
      }
    for (int i = 0; i < samples; ++i) {
      const Vec3 x = random_mean(random, part, all_vertices(part));
      const Real distance = distance_to_surface(body, x), depth = body.depth_in(p, x);
      if (depth >= kCap) {
        EXPECT_GE(distance, kCap * (1 - 1e-12));
        continue;
      }
      ratio.least = std::min(ratio.least, depth / distance);
      ratio.largest = std::max(ratio.largest, depth / distance);
    }
  }
  std::printf(
      "  %-22s %3zu parts, %4zu planes, %4zu terms: depth over distance %.4f to %.10f, on the surface %.1e, "
      "across cuts %.1e\n",
      name, body.parts.size(), planes, terms, ratio.least, ratio.largest, on_surface, across_cuts);
  EXPECT_LT(on_surface, 1e-10) << name;
  EXPECT_LT(across_cuts, 1e-10) << name;
  EXPECT_LE(ratio.largest, 1 + 1e-10) << name;
  return ratio;
}

TEST(DepthField, IsADistanceToTheWholeSurface) {
  const struct {
    const char* name;
    Parts parts;
  } bodies[] = {{"L in 2", l_in_2()},
                {"L in 3", l_in_3()},
                {"L in 6", l_in_6()},
                {"cross in 3", cross_in_3()},
                {"cross in 5", cross_in_5()},
                {"U in 3", u_in_3()},
                {"U in 5", u_in_5()},
                {"slanted T", slanted_t(false)},
                {"slanted T, cut", slanted_t(true)},
                {"hexapod", hexapod()},
                {"hexapod, cut", hexapod_cut_otherwise()},
                {"rock 32", star_rock(bumpy_radius, 1, false)},
                {"rock 64", star_rock(bumpy_radius, 1, true)},
                {"rock 128", star_rock(bumpy_radius, 2, false)}};
  for (const auto& [name, parts] : bodies) {
    const auto start = std::chrono::steady_clock::now();
    const Body body(parts);
    std::printf("%.0f ms ", 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    const Ratio ratio = check_field(name, body, 400);
    EXPECT_GT(ratio.least, 0.57) << name;
  }
}

void expect_same_field(const char* name, const Body& one, const Body& other) {
  std::mt19937 random(5);
  Real worst = 0;
  for (std::size_t p = 0; p < one.parts.size(); ++p)
    for (int i = 0; i < 2000; ++i) {
      const Vec3 x = random_mean(random, one.parts[p], all_vertices(one.parts[p]));
      worst = std::max(worst, std::abs(one.depth_in(p, x) - other.depth_in(other.part_of(x), x)));
    }
  std::printf("  %-22s the two cuts' fields differ by %.1e\n", name, worst);
  EXPECT_LT(worst, 1e-12) << name;
}

TEST(DepthField, DoesNotDependOnTheCut) {
  expect_same_field("L in 2 and 3", Body(l_in_2()), Body(l_in_3()));
  expect_same_field("L in 6 and 3", Body(l_in_6()), Body(l_in_3()));
  expect_same_field("cross in 3 and 5", Body(cross_in_3()), Body(cross_in_5()));
  expect_same_field("U in 3 and 5", Body(u_in_3()), Body(u_in_5()));
  expect_same_field("slanted T", Body(slanted_t(false)), Body(slanted_t(true)));
  expect_same_field("hexapod", Body(hexapod()), Body(hexapod_cut_otherwise()));
  expect_same_field("rock", Body(star_rock(bumpy_radius, 1, false)), Body(star_rock(bumpy_radius, 1, true)));
}

TEST(DepthField, OfAConvexBodyIsTheLeastDepthBelowItsFaces) {
  for (const std::array<int, 3>& counts : {std::array<int, 3>{1, 1, 1}, {2, 1, 1}, {3, 3, 3}}) {
    const Body body(cut_box({1, 1, 1}, counts));
    for (const PartDepthField& field : body.fields) {
      EXPECT_EQ(field.planes.size(), 6u);
      EXPECT_TRUE(field.greatest.empty());
    }
  }
}

TEST(DepthField, BehindAReentrantEdgeIsTheGreaterDepth) {
  const Body body(l_in_3());
  const Vec3 x{0.9, 0.8, 0.5};  // behind the inner corner at (1, 1)
  EXPECT_NEAR(body.depth_in(body.part_of(x), x), 0.2, 1e-15);
  // The corner's part needs one term of two planes besides the flat faces' planes.
  ASSERT_EQ(body.fields[0].greatest.size(), 1u);
  EXPECT_EQ(body.fields[0].greatest[0].size(), 2u);
}

}  // namespace
