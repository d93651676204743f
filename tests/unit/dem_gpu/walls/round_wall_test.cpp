// SPDX-License-Identifier: Apache-2.0
// Balls, cylinders and cones against polyhedra: integrals against closed forms, the force against the gradient of the
// depth's integral over the overlap, work round closed paths.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <numbers>
#include <string>

#include "dem_gpu/walls/round_integrals.h"
#include "tests/support/pair_integrals.h"
#include "tests/support/wall_records.h"

namespace {

using namespace test_support;
using dem_gpu::FacePolygon;
using dem_gpu::Pose;
using dem_gpu::RoundSurface;
using dem_gpu::WallIntegrals;
using dem_gpu::WallRecord;

/// One convex part, ready for the kernels.
class Body {
 public:
  explicit Body(const catalog::ConvexPart& part) : part_(part), shapes_({part}, {part}) {}

  const catalog::ConvexPart& part() const { return part_; }
  WallIntegrals on(const WallRecord& wall, const Pose& pose) const {
    WallIntegrals integrals;
    EXPECT_TRUE(integrate_part_on_round_wall(dem_gpu::part_view(view(shapes_.columns()), 0), pose, wall, integrals));
    return integrals;
  }

 private:
  catalog::ConvexPart part_;
  PairIntegrals shapes_;
};

Pose pose_of(const Vec3& position, const Quaternion& orientation) {
  return {rotation_matrix(orientation), position, 1};
}

TEST(RoundWall, FlatFaceInACylinder) {
  // A cube pressed flat into a cylinder of radius R by d beside the middle of its face: across the strip the depth is
  // hypot(R + d, y) - R, its integral closed.
  const Body cube(unit_cube());
  for (const Real radius : {2.5, 5., 20., 100.}) {
    const WallRecord wall = record_of(dem_gpu::Cylinder{{0, 0, -5}, {0, 0, 1}, 10, radius});
    for (const Real d : {0.05, 0.001}) {
      const auto found = cube.on(wall, pose_of({radius - 0.5 + d, 0, 0}, {}));
      const Real h = radius + d;
      const auto below = [&](Real y) { return (y * std::hypot(h, y) + h * h * std::asinh(y / h)) / 2 - radius * y; };
      // Half an edge over the radius, 0.2 at most, to the eighth power of Gauss's rule: 3e-6 of what bends.
      const Real sides = found.force.x + 2 * below(0.5);  // the other faces push along y and z alone
      EXPECT_LT(std::abs(sides), 2e-8 * 2 * below(0.5) + kSingle.integral) << radius << ' ' << d;
      EXPECT_LT(std::abs(found.force.y) + std::abs(found.force.z), 1e-12 + kSingle.integral);
      EXPECT_NEAR(found.largest_depth, std::hypot(h, 0.5) - radius, 1e-12 + kSingle.position);
    }
  }
}

TEST(RoundWall, FaceOnABallAndAShaft) {
  const Body cube(unit_cube());
  const auto force_on_face = [&](const WallRecord& wall, Real height) {
    return cube.on(wall, pose_of({0.05, 0.02, height + 0.5}, {})).force.z;
  };
  const Real radius = 0.1, h = 0.095, rho = std::sqrt(radius * radius - h * h);
  const auto ball = record_of(dem_gpu::Ball{{0, 0, 0}, radius, dem_gpu::SolidSide::within});
  const Real on_ball = 2 * M_PI * (radius * rho * rho / 2 - (std::pow(radius, 3) - std::pow(h, 3)) / 3);
  EXPECT_NEAR(force_on_face(ball, h) / on_ball, 1, 1e-5 + kSingle.relative);  // seen over whole turns: eighth power
  const auto shaft = record_of(dem_gpu::Cylinder{{-2, 0, 0}, {1, 0, 0}, 4, radius, dem_gpu::SolidSide::within});
  // Across the strip: integral of R - sqrt(h2 + y2); the face covers a length of 1.
  const Real across = radius * rho - h * h * std::asinh(rho / h);
  EXPECT_NEAR(force_on_face(shaft, h) / across, 1, 1e-5 + kSingle.relative);
}

/// Section of a convex part at height z of its own frame, placed, counter-clockwise about the turned z axis.
FacePolygon section(const catalog::ConvexPart& part, Real z, const Pose& pose) {
  std::vector<Vec3> points;
  for (const catalog::ConvexFace& face : part.faces)
    for (std::size_t i = 0; i < face.vertices.size(); ++i) {
      const Vec3 a = to_vec3(part.vertices[face.vertices[i]]);
      const Vec3 b = to_vec3(part.vertices[face.vertices[(i + 1) % face.vertices.size()]]);
      if ((a.z < z) == (b.z < z) || a.z > b.z) continue;  // each edge once: it runs both ways
      points.push_back(a + ((z - a.z) / (b.z - a.z)) * (b - a));
    }
  Vec3 middle;
  for (const Vec3& p : points) middle += p / static_cast<Real>(points.size());
  std::sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return std::atan2(a.y - middle.y, a.x - middle.x) < std::atan2(b.y - middle.y, b.x - middle.x);
  });
  FacePolygon polygon;
  polygon.count = 0;
  polygon.is_truncated = false;
  for (const Vec3& p : points) append(polygon, dem_gpu::rounded(pose.rotation * p));
  return polygon;
}

/// Integral of the wall's depth over one section [m3].
Real section_integral(const catalog::ConvexPart& part, const WallRecord& wall, const Pose& pose, Real z) {
  const FacePolygon polygon = section(part, z, pose);
  WallIntegrals integrals;
  if (polygon.count >= 3)
    dem_gpu::RoundFace<WallIntegrals>(RoundSurface(wall, pose.position), polygon, pose.rotation * Vec3{0, 0, 1}, true)
        .add_to(integrals);
  return integrals.weight;
}

/// The integral of the wall's depth over the overlap [m4], over the body's sections along its z axis, none of which is
/// a face that the force is made of. Between corners the sections change smoothly.
class Potential {
 public:
  /// For poses next to `pose`.
  Potential(const catalog::ConvexPart& part, const WallRecord& wall, const Pose& pose) : part_(part), wall_(wall) {
    std::vector<Real> levels;
    for (const catalog::Point& vertex : part.vertices) levels.push_back(vertex[2]);
    std::sort(levels.begin(), levels.end());
    constexpr int kCells = 200;
    const Real bottom = levels.front(), cell = (levels.back() - bottom) / kCells;
    Real low = levels.back(), high = bottom;
    for (int k = 0; k < kCells; ++k) {
      const Real z = bottom + cell * (k + Real(0.5));
      if (section_integral(part, wall, pose, z) > 0)
        low = std::min(low, z - 2 * cell), high = std::max(high, z + 2 * cell);
    }
    for (const Real level : levels) breaks_.push_back(std::clamp(level, low, high));
  }

  Real at(const Pose& pose) const {
    constexpr int kPanels = 100;
    Real sum = 0;
    for (std::size_t l = 1; l < breaks_.size(); ++l) {
      const Real height = (breaks_[l] - breaks_[l - 1]) / kPanels;
      if (!(height > 1e-12)) continue;
      for (int k = 0; k < kPanels; ++k)
        for (int i = 0; i < dem_gpu::GaussRule::kPoints; ++i)
          sum += height * dem_gpu::GaussRule::weight(i) *
                 section_integral(part_, wall_, pose, breaks_[l - 1] + height * (k + dem_gpu::GaussRule::point(i)));
    }
    return sum;
  }

 private:
  const catalog::ConvexPart& part_;
  const WallRecord& wall_;
  std::vector<Real> breaks_;
};

struct NamedWall {
  std::string name;
  WallRecord wall;
  bool is_outside;  // bodies are outside
};

/// Five sizes of the body in radius, or a ball and a shaft half as large as it.
std::vector<NamedWall> round_walls() {
  const Vec3 axis = Vec3{1, 2, 2} / 3, base = -10 * axis;
  constexpr auto kWithin = dem_gpu::SolidSide::within;
  return {{"in a cylinder", record_of(dem_gpu::Cylinder{base, axis, 20, 5}), false},
          {"in a cone", record_of(dem_gpu::Cone{base, axis, 20, 8, 2}), false},
          {"in a sphere", record_of(dem_gpu::Ball{{}, 5}), false},
          {"on a shaft", record_of(dem_gpu::Cylinder{base, axis, 20, 1.5, kWithin}), true},
          {"on a cone", record_of(dem_gpu::Cone{base, axis, 20, 4, 1, kWithin}), true},
          {"on a ball", record_of(dem_gpu::Ball{{}, 1.5, kWithin}), true}};
}

/// Johnson's solid J91, the bilunabirotunda: triangles, squares and pentagons on 14 corners. `half`: half its width
/// between the squares.
catalog::ConvexPart j91(Real half) {
  const Real golden = (1 + std::sqrt(Real(5))) / 2, a = 1 / golden;
  std::vector<Vec3> corners;
  std::vector<std::vector<int>> loops;
  const auto add_face = [&](std::vector<Vec3> face) {
    Vec3 middle;
    for (const Vec3& corner : face) middle += corner;
    if (dot(cross(face[1] - face[0], face[2] - face[0]), middle) < 0) std::reverse(face.begin(), face.end());
    loops.emplace_back();
    for (const Vec3& corner : face) {
      const auto place = std::find_if(corners.begin(), corners.end(),
                                      [&](const Vec3& known) { return norm(known - half * corner) < 1e-9; });
      loops.back().push_back(static_cast<int>(place - corners.begin()));
      if (place == corners.end()) corners.push_back(half * corner);
    }
  };
  for (const Real y : {1, -1}) {
    add_face({{a, y, a}, {-a, y, a}, {-a, y, -a}, {a, y, -a}});
    for (const Real z : {1, -1}) add_face({{0, 0, z}, {a, y, a * z}, {-a, y, a * z}});
    for (const Real x : {1, -1}) add_face({{a * x, y, a}, {a * x, y, -a}, {golden * x, a * y, 0}});
  }
  for (const Real x : {1, -1})
    for (const Real z : {1, -1})
      add_face({{0, 0, z}, {a * x, 1, a * z}, {golden * x, a, 0}, {golden * x, -a, 0}, {a * x, -1, a * z}});
  return part_of(corners, loops);
}

std::vector<std::pair<std::string, Body>> bodies() {
  return {{"cube", Body(unit_cube())}, {"J91", Body(j91(0.4))}, {"needle", Body(dem_gpu::box_part({0.05, 0.05, 1}))}};
}

/// A body that touches the wall's middle in a random attitude, pressed in by `depth`.
Pose touching(const Body& body, const NamedWall& wall, Real depth, std::mt19937& random) {
  const Quaternion attitude = random_rotation(random);
  Vec3 out = random_direction(random);
  if (wall.wall.kind != dem_gpu::WallKind::sphere) {
    out -= dot(out, wall.wall.direction) * wall.wall.direction;
    out = out / norm(out);
  }
  // Between a place without contact and one in it.
  Real apart = wall.is_outside ? 6 : 0, pressed = wall.is_outside ? 2 : 6;
  if (wall.is_outside) pressed = wall.wall.kind == dem_gpu::WallKind::cone ? 2.5 : 1.5;
  for (int i = 0; i < 50; ++i) {
    const Real middle = (apart + pressed) / 2;
    (body.on(wall.wall, pose_of(middle * out, attitude)).weight > 0 ? pressed : apart) = middle;
  }
  return pose_of((apart + (wall.is_outside ? -depth : depth)) * out, attitude);
}

Pose shifted(const Pose& pose, const Vec3& by) { return {pose.rotation, pose.position + by, pose.scale}; }
Pose turned(const Pose& pose, const Vec3& axis, Real angle) {
  const dem_gpu::Mat3 turn = rotation_matrix(dem_gpu::axis_angle(axis, angle)), r = pose.rotation;
  return {{turn * r.column_x, turn * r.column_y, turn * r.column_z}, pose.position, pose.scale};
}

/// Central difference of fourth order.
template <class Function>
Real slope_of(const Function& f, Real h) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

TEST(RoundWall, ForceAndTorqueAreTheGradientOfThePotential) {
  std::mt19937 random(11);
  const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const NamedWall& wall : round_walls())
    for (const auto& [name, body] : bodies()) {
      Real worst_force = 0, worst_torque = 0;
      for (int i = 0; i < 3; ++i) {
        const Real depth = std::uniform_real_distribution<Real>(0.02, 0.06)(random);
        const Pose pose = touching(body, wall, depth, random);
        const auto found = body.on(wall.wall, pose);
        const Potential potential(body.part(), wall.wall, pose);
        Vec3 force, torque;
        for (const Vec3& axis : axes) {
          force -= slope_of([&](Real s) { return potential.at(shifted(pose, s * axis)); }, 3e-4) * axis;
          torque -= slope_of([&](Real s) { return potential.at(turned(pose, axis, s)); }, 3e-4) * axis;
        }
        ASSERT_GT(norm(found.force), 0) << wall.name << ' ' << name;
        worst_force = std::max(worst_force, norm(found.force - force) / norm(found.force));
        worst_torque = std::max(worst_torque, norm(found.moment - torque) / (norm(found.force) * 0.5));
      }
      std::printf("  %-6s %-14s off the gradient: force %.1e, torque %.1e\n", name.c_str(), wall.name.c_str(),
                  worst_force, worst_torque);
      EXPECT_LT(worst_force, 1e-6 + kSingle.slope) << wall.name << ' ' << name;
      EXPECT_LT(worst_torque, 1e-6 + kSingle.slope) << wall.name << ' ' << name;
    }
}

TEST(RoundWall, WorkRoundAClosedPathVanishes) {
  std::mt19937 random(12);
  for (const NamedWall& wall : round_walls())
    for (const auto& [name, body] : bodies()) {
      const Pose start = touching(body, wall, 0.05, random);
      std::array<Vec3, 2> shift, turn;
      for (int k = 0; k < 2; ++k)
        shift[k] = Real(0.02) * random_direction(random), turn[k] = Real(0.05) * random_direction(random);
      // Slides and turns of two harmonics; torque and force at the middle of each of many steps.
      const auto at = [&](Real s) {
        const Real a = 2 * std::numbers::pi * s;
        const Vec3 w = std::sin(2 * a) * turn[0] + (1 - std::cos(a)) * turn[1];
        return shifted(turned(start, unit_or(w, {1, 0, 0}), norm(w)),
                       std::sin(a) * shift[0] + (1 - std::cos(a)) * shift[1]);
      };
      constexpr int kSteps = 4000;
      Real work = 0, least = 0, most = 0;
      Pose here = at(0);
      for (int k = 0; k < kSteps; ++k) {
        const Pose next = at((k + 1) / Real(kSteps)), middle = at((k + Real(0.5)) / kSteps);
        const auto found = body.on(wall.wall, middle);
        // Turn over the step, to third order: half the sum of the axes' changes across the middle ones.
        const Vec3 turned =
            Real(0.5) * (cross(middle.rotation.column_x, next.rotation.column_x - here.rotation.column_x) +
                         cross(middle.rotation.column_y, next.rotation.column_y - here.rotation.column_y) +
                         cross(middle.rotation.column_z, next.rotation.column_z - here.rotation.column_z));
        work += dot(found.force, next.position - here.position) + dot(found.moment, turned);
        least = std::min(least, work), most = std::max(most, work);
        here = next;
      }
      std::printf("  %-6s %-14s work round a closed path over the swing: %.1e\n", name.c_str(), wall.name.c_str(),
                  work / (most - least));
      // The pass over the steps leaves some 1e-6 of the swing, the square of a step's share of the path.
      EXPECT_LT(std::abs(work), (1e-5 + kSingle.relative) * (most - least)) << wall.name << ' ' << name;
    }
}

}  // namespace
