// SPDX-License-Identifier: Apache-2.0
// The depth potential: closed forms, and force and torque as the gradient of the energy found by another route.
#include <gtest/gtest.h>

#include <numbers>

#include "dem_gpu/narrow_phase/closest_point.h"
#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;
using dem_gpu::axis_angle;
using dem_gpu::DepthIntegrals;
using HardeningIntegrals = dem_gpu::DepthIntegralsOf<dem_gpu::HardeningProfile>;

/// Solid whose faces all touch one sphere about its centre: what lies deeper than t is the solid shrunk by 1 - t/r.
struct Solid {
  catalog::ConvexPart part;
  Real insphere;
};

Solid cube_solid() { return {unit_cube(), 0.5}; }
Solid tetrahedron_solid() { return {tetrahedron(1.5), 1.5 / (2 * std::sqrt(Real(3)))}; }
Solid octahedron_solid() { return {octahedron(0.8), 0.8 / std::sqrt(Real(3))}; }

/// U / k = integral over the overlap of psi_a + psi_b, psi = depth (1 + rate depth), as the sum over depth t of
/// d psi / dt times the volumes that lie deeper than t (Cavalieri): Gauss-Legendre points in panels. Uses overlap
/// volumes only.
Real energy(const PairIntegrals& pair, const Solid& solid_a, const Solid& solid_b, const Placed& a, const Placed& b,
            Real rate) {
  constexpr int kPanels = 200;
  constexpr Real kPoint = 0.7745966692414834;
  Real sum = 0;
  const auto layers = [&](Real insphere, auto volume_at) {
    const Real panel = insphere / kPanels;
    for (int i = 0; i < kPanels; ++i) {
      const Real middle = (i + 0.5) * panel, half = panel / 2;
      const auto slope_at = [&](Real t) { return (1 + 2 * rate * t) * volume_at(t); };
      sum += half *
             (5 * slope_at(middle - kPoint * half) + 8 * slope_at(middle) + 5 * slope_at(middle + kPoint * half)) / 9;
    }
  };
  layers(solid_a.insphere, [&](Real t) {
    return pair.volume({a.position, a.orientation, a.scale - t / solid_a.insphere}, b);
  });
  layers(solid_b.insphere, [&](Real t) {
    return pair.volume(a, {b.position, b.orientation, b.scale - t / solid_b.insphere});
  });
  return sum;
}

template <class Integrals>
void expect_gradient(const Solid& solid_a, const Solid& solid_b, const Placed& a, const Placed& b,
                     const Integrals& empty, Real rate) {
  const PairIntegrals pair({solid_a.part}, {solid_b.part});
  const auto integrals = pair.of<Integrals>(a, b, false, empty);
  ASSERT_GT(integrals.weight, 0);
  const Vec3 force = rotate(a.orientation, integrals.force), torque = rotate(a.orientation, integrals.moment);
  const Real h = 1e-4;
  const auto slope = [&](const auto& placed_at) {
    return (energy(pair, solid_a, solid_b, placed_at(h), b, rate) -
            energy(pair, solid_a, solid_b, placed_at(-h), b, rate)) /
           (2 * h);
  };
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Real shifted = slope([&](Real s) { return Placed{a.position + s * axis, a.orientation, 1}; });
    const Real turned = slope([&](Real s) { return Placed{a.position, axis_angle(axis, s) * a.orientation, 1}; });
    EXPECT_NEAR(dot(force, axis), -shifted, (2e-6 + kSingle.slope) * norm(force));
    EXPECT_NEAR(dot(torque, axis), -turned, (2e-6 + kSingle.slope) * (norm(force) + norm(torque)));
  }
}

/// Of the linear law, and of one that hardens over a tenth of an edge.
void expect_gradient(const Solid& solid_a, const Solid& solid_b, const Placed& a, const Placed& b) {
  expect_gradient(solid_a, solid_b, a, b, DepthIntegrals{}, 0);
  HardeningIntegrals hardening;
  hardening.profile_a.rate = hardening.profile_b.rate = 10;
  expect_gradient(solid_a, solid_b, a, b, hardening, 10);
}

TEST(DepthPotential, ForceAndTorqueAreTheGradientOfTheEnergy) {
  const Placed a{{0.1, -0.2, 0.3}, axis_angle({0, 0.6, 0.8}, 0.4)};
  expect_gradient(cube_solid(), cube_solid(), a, {{0.9, 0.1, 0.7}, axis_angle({1, 0, 0}, 0.7)});
  expect_gradient(cube_solid(), cube_solid(), {}, {{0.1, 0.05, 1.2}, vertex_down()});  // vertex in a face
  expect_gradient(cube_solid(), cube_solid(), {},
                  {{0.31, 0.23, 0.93}, axis_angle({0.6, 0.8, 0}, 0.02)});  // near face on face
  expect_gradient(cube_solid(), tetrahedron_solid(), a, {{0.6, 0.2, 0.8}, axis_angle({0, 1, 0}, 1.1)});
  expect_gradient(octahedron_solid(), tetrahedron_solid(), a, {{0.5, 0.1, 0.6}, axis_angle({0.6, 0, 0.8}, 2.1)});
  expect_gradient(cube_solid(), octahedron_solid(), a, {{0.2, -0.1, 0.5}, axis_angle({0.6, 0, 0.8}, 0.3)});  // deep
}

TEST(DepthPotential, StiffnessIsTheSlopeOfTheForceAndDepthGoesAlongIt) {
  // By finite differences of the force, and depth known from the attitude.
  struct Pose {
    const char* name;
    Quaternion a, b;
    Real touch;  // distance of centres along z at touch
  };
  const Real edge = std::sqrt(0.5), vertex = std::sqrt(0.75), d = 0.01, h = kIsMixed ? 1e-4 : 1e-5;
  const Quaternion other_edge = axis_angle({0, 1, 0}, std::numbers::pi / 4);
  const Pose poses[] = {{"face on face", {}, axis_angle({0, 0, 1}, 0.3), 1},
                        {"edge on face", {}, edge_down(), 0.5 + edge},
                        {"vertex on face", {}, vertex_down(), 0.5 + vertex},
                        {"edge on edge", edge_down(), other_edge, 2 * edge}};
  const PairIntegrals cubes({unit_cube()}, {unit_cube()});
  for (const Pose& pose : poses) {
    for (const Real rate : {0.0, 100.0}) {
      HardeningIntegrals empty;
      empty.profile_a.rate = empty.profile_b.rate = rate;
      const auto contact_at = [&](Real depth) {
        const Placed a{{}, pose.a}, b{{0, 0, pose.touch - depth}, pose.b};
        dem_gpu::ElasticContact contact, hardened;
        EXPECT_TRUE(cubes.of<DepthIntegrals>(a, b).to_contact(dem_gpu::DepthPotential{1}, a.pose(), contact));
        EXPECT_TRUE(cubes.of<HardeningIntegrals>(a, b, false, empty)
                        .to_contact(dem_gpu::DepthPotential{1}, a.pose(), hardened));
        if (rate == 0) {
          EXPECT_EQ(hardened.force, contact.force) << "without hardening the linear law, to the bit";
        }
        return hardened;
      };
      const auto contact = contact_at(d);
      const Real slope = (norm(contact_at(d + h).force) - norm(contact_at(d - h).force)) / (2 * h);
      EXPECT_NEAR(contact.stiffness / slope, 1, 1e-4 + kSingle.slope) << pose.name << ", rate " << rate;
      EXPECT_NEAR(contact.depth / d, 1, 2.5 * d) << pose.name;  // rims of the fields lean
    }
  }
}

TEST(DepthPotential, FlatFaceOnFlatFace) {
  // A cube of edge L pressed by d into a larger one: the large one's field over the small face is d L^2; the small
  // one's field over the large face is least(d, distance to the rim), whose integral is (L^3 - (L - 2d)^3) / 6.
  for (const Real d : {1e-6, 1e-3, 0.02}) {
    if (kIsMixed && d < 1e-5) continue;  // touching
    const Real L = 0.5;
    const PairIntegrals pair({dem_gpu::box_part({2, 2, 2})}, {dem_gpu::box_part({L, L, L})});
    const auto integrals = pair.of<DepthIntegrals>({}, {{0.2, -0.1, 1 + L / 2 - d}, {}});
    const Real inner = L - 2 * d, rim = (L * L * L - inner * inner * inner) / 6;
    EXPECT_NEAR(integrals.force.z / -(d * L * L + rim), 1, 1e-9 + kSingle.position / d);
    EXPECT_NEAR(integrals.force.z / (-2 * d * L * L), 1, 1.01 * d / L * 1.0 + 1e-9 + kSingle.position / d)
        << "F = 2 k A d to first order";
    EXPECT_NEAR(integrals.force.x, 0, 1e-15);
    EXPECT_NEAR(integrals.force.y, 0, 1e-15);
    EXPECT_NEAR(integrals.depth_along({0, 0, 1}), d, 1e-12 + kSingle.position);
    // The weighted point lies over the small cube's centre.
    EXPECT_NEAR(integrals.weighted_point.x / integrals.weight, 0.2, 1e-12 + kSingle.position);
    EXPECT_NEAR(integrals.weighted_point.y / integrals.weight, -0.1, 1e-12 + kSingle.position);
  }
}

TEST(HardeningProfile, IntegralsOverATriangleAreExact) {
  // Against Gauss-Legendre points of a square folded into the triangle (Duffy, SIAM J. Numer. Anal. 19 (1982)
  // 1260-1262): exact for polynomials of this degree.
  const dem_gpu::DepthTriangle t{{0.1, 0.2, 0.3}, {1.3, 0.1, -0.4}, {0.4, 1.1, 0.7}, 0.3, 0.01, 0.7, 0};
  dem_gpu::DepthTriangle triangle = t;
  triangle.area = norm(cross(t.b - t.a, t.c - t.a)) / 2;
  const Real rate = 3;
  const Real points[] = {0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
  const Real weights[] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};
  Real depth = 0, area = 0;
  Vec3 moment;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const Real b = points[i], c = (1 - b) * points[j], a = 1 - b - c;
      const Real weight = 2 * triangle.area * weights[i] * weights[j] * (1 - b);
      const Real d = a * t.depth_a + b * t.depth_b + c * t.depth_c;
      depth += weight * d * (1 + rate * d);
      moment += (weight * d * (1 + rate * d)) * (a * Vec3(t.a) + b * Vec3(t.b) + c * Vec3(t.c));
      area += weight * (1 + 2 * rate * d);
    }
  const auto found = dem_gpu::HardeningProfile{dem_gpu::rounded(rate)}.integrate(triangle);
  EXPECT_NEAR(found.depth, depth, 1e-14 + kSingle.integral);
  EXPECT_NEAR(dem_gpu::norm(Vec3(found.depth_moment) - moment), 0, 1e-14 + kSingle.integral);
  EXPECT_NEAR(found.area, area, 1e-14 + kSingle.integral);
}

TEST(DepthPotential, ReciprocalUnderExchange) {
  std::mt19937 random(17);
  for (int i = 0; i < 50; ++i) {
    const PairIntegrals pair({random_convex_part(random, 10)}, {random_convex_part(random, 10)});
    const Placed a{0.1 * random_direction(random), random_rotation(random), 1.3};
    const Placed b{1.6 * random_direction(random), random_rotation(random), 0.7};
    dem_gpu::ElasticContact ab, ba;
    const dem_gpu::DepthPotential law{2};
    const bool touching = pair.of<DepthIntegrals>(a, b).to_contact(law, a.pose(), ab);
    ASSERT_EQ(pair.of<DepthIntegrals>(b, a, true).to_contact(law, b.pose(), ba), touching);
    if (!touching) continue;
    const Real size = norm(ab.force), relative = 1e-12 + kSingle.relative;
    EXPECT_LT(norm(ab.force + ba.force), relative * size + 1e-17);
    const Vec3 torque_b = cross(b.position - a.position, ab.force) - ab.torque_a;
    EXPECT_LT(norm(torque_b - ba.torque_a), relative * size + 1e-17);
    EXPECT_LT(norm(ab.point - ba.point), 1e-7 + kSingle.relative);
    EXPECT_NEAR(ab.stiffness, ba.stiffness, relative * ab.stiffness + 1e-15);
    EXPECT_NEAR(ab.depth, ba.depth, 1e-9 + kSingle.position);
  }
}

TEST(DepthPotential, AFaceInACutCountsOnceHoweverItLies) {
  // A block of two or four parts, and a bar of one or two parts that a cut of the block is flush with, or whose own cut
  // is flush with the block's: but for tilts and offsets from rounding to far above it. The parts on both sides of a
  // cut must tell the same of the faces in it.
  const auto block = [](std::array<int, 3> counts) { return cut_box({1, 1, 1}, counts); };
  const auto bar = [](int parts) { return cut_box({0.5, 0.25, 1}, {parts, 1, 1}); };
  const PairIntegrals whole(block({1, 1, 1}), bar(1));
  const PairIntegrals cut[] = {{block({2, 1, 1}), bar(1)},
                               {block({2, 2, 1}), bar(1)},
                               {block({2, 1, 1}), bar(2)},
                               {block({2, 2, 1}), bar(2)},
                               {block({1, 1, 1}), bar(2)}};
  std::mt19937 random(31);
  for (const Real x : {0.25, -0.25, 0.0})
    for (Real tilt = 1e-16; tilt < 2e-6; tilt *= std::sqrt(10.0))
      for (const Real offset : {0.0, 1e-15, 1e-13, 1e-12, 1e-11, 1e-9}) {
        const Vec3 turn = tilt / 2 * random_direction(random);
        const Placed b{Vec3{x, -0.125, 0.9} + offset * random_direction(random),
                       dem_gpu::normalized(Quaternion{1, turn.x, turn.y, turn.z})};
        const auto expected = whole.of<DepthIntegrals>({}, b);
        for (const PairIntegrals& pair : cut) {
          const auto found = pair.of<DepthIntegrals>({}, b);
          EXPECT_LT(norm(found.force - expected.force), 1e-9 + kSingle.integral) << x << ", " << tilt << ", " << offset;
          EXPECT_LT(norm(found.moment - expected.moment), 1e-9 + kSingle.integral)
              << x << ", " << tilt << ", " << offset;
        }
      }
}

TEST(DepthPotential, RoundBodyOnABlock) {
  // Where both fields grow along nearly the same direction, F = k (V + V) n. A polyhedron of 60 corners near the unit
  // sphere, pressed into a block: the facets' normals lean off the vertical by up to acos(1 - depth).
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i) {  // Fibonacci points
    const Real z = 1 - (2 * i + 1) / 60.0, r = std::sqrt(1 - z * z), t = 2.399963229728653 * i;
    points.push_back({r * std::cos(t), r * std::sin(t), z});
  }
  const PairIntegrals pair({dem_gpu::box_part({4, 4, 4})}, {hull_of(points)});
  std::mt19937 random(2);
  const Real d = 0.1;
  for (int i = 0; i < 100; ++i) {
    const Placed round{{0, 0, 3 - d}, random_rotation(random)};
    const Real ratio = -pair.of<DepthIntegrals>({}, round).force.z / (2 * pair.volume({}, round));
    EXPECT_LE(ratio, 1 + 1e-12);
    EXPECT_GT(ratio, 1 - d);
  }
}

TEST(DepthPotential, CapHoldsTheFieldDownDeepInside) {
  // Field of a thin plate deep inside a capped cube: the cap times its area, both sides cancelling.
  const Real cap = 0.1;  // in equivalent diameters
  const PairIntegrals pair({unit_cube()}, {dem_gpu::box_part({0.1, 0.1, 0.1})}, cap);
  const Real diameter = std::cbrt(6 / std::numbers::pi);
  const auto integrals = pair.of<DepthIntegrals>({}, {});
  EXPECT_NEAR(integrals.weight, 6 * 0.01 * cap * diameter, 1e-12 + kSingle.position);
  EXPECT_LT(norm(integrals.force), 1e-15);
}

/// Distance to a convex part, every feature tried.
Real exhaustive_distance(const catalog::ConvexPart& part, const Vec3& x) {
  Real highest = -1e300, nearest = 1e300;
  for (const catalog::ConvexFace& face : part.faces) {
    const Vec3 normal = to_vec3(face.plane.normal);
    const Real height = dot(normal, x) - face.plane.offset;
    highest = std::max(highest, height);
    const Vec3 foot = x - height * normal;
    bool inside = true;
    for (std::size_t c = 0; c < face.vertices.size(); ++c) {
      const Vec3 p = to_vec3(part.vertices[face.vertices[c]]);
      const Vec3 q = to_vec3(part.vertices[face.vertices[(c + 1) % face.vertices.size()]]);
      if (dot(cross(q - p, foot - p), normal) < 0) inside = false;
      const Real share = std::clamp(dot(x - p, q - p) / norm_squared(q - p), Real(0), Real(1));
      nearest = std::min(nearest, norm(x - p - share * (q - p)));
    }
    if (inside) nearest = std::min(nearest, std::abs(height));
  }
  return highest <= 0 ? highest : nearest;
}

TEST(ClosestPoint, EqualsExhaustiveSearch) {
  std::mt19937 random(23);
  for (int i = 0; i < 20; ++i) {
    const catalog::ConvexPart part = random_convex_part(random, 14, {1, 0.7, 0.3});
    const PairIntegrals pair({part}, {unit_cube()});
    const dem_gpu::PartView part_view = dem_gpu::part_view(view(pair.columns()), 0);
    for (int k = 0; k < 200; ++k) {
      const Vec3 x = std::uniform_real_distribution<Real>(0, 1.6)(random) * random_direction(random);
      const Real reach = 0.6, expected = exhaustive_distance(part, x);
      const dem_gpu::PartDistance found = distance_to_part(part_view, x, reach);
      if (expected > reach) {
        EXPECT_GT(found.distance, reach);
        continue;
      }
      EXPECT_NEAR(found.distance, expected, 1e-12 + kSingle.position);
      EXPECT_NEAR(norm(found.outward), 1, 1e-12 + kSingle.position);
      // Going back along the direction by the distance leads to the surface.
      EXPECT_NEAR(exhaustive_distance(part, x - found.distance * found.outward), 0, 1e-9 + kSingle.position);
    }
  }
}

}  // namespace
