// SPDX-License-Identifier: Apache-2.0
// Bodies of many faces, all of which may be the nearest in one part: more depths than one overlap or one face holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "dem_gpu/overlap_probe.h"
#include "tests/property/dem_gpu/plain_depth.h"
#include "tests/support/dem_scenes.h"
#include "tests/support/precision.h"

namespace {

using namespace test_support;
using dem_gpu::BodyPose;
using dem_gpu::PosePair;

constexpr int kSides = 240;
constexpr double kHalfHeight = 1;

struct Corner {
  double x, y;
  bool is_cut;  // the side from here to the next corner lies on a cut
};
using Outline = std::vector<Corner>;

/// Corners on an ellipse, counter-clockwise.
Outline ellipse() {
  Outline outline;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.3) / kSides;
    outline.push_back({std::cos(angle), 0.97 * std::sin(angle), false});
  }
  return outline;
}

/// What lies at sign * x <= sign * at.
Outline behind(const Outline& outline, double sign, double at) {
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Corner &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double ha = sign * (a.x - at), hb = sign * (b.x - at);
    if (ha <= 0) kept.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0))
      kept.push_back({at, a.y + ha / (ha - hb) * (b.y - a.y), hb > 0 || a.is_cut});
  }
  return kept;
}

catalog::ConvexPart prism(const Outline& outline) {
  const int n = static_cast<int>(outline.size());
  std::vector<Vec3> vertices;
  for (const double z : {-kHalfHeight, kHalfHeight})
    for (const Corner& corner : outline) vertices.push_back({corner.x, corner.y, z});
  std::vector<std::vector<int>> loops(2);
  for (int i = 0; i < n; ++i) {
    loops[0].push_back(n - 1 - i);
    loops[1].push_back(n + i);
    loops.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  catalog::ConvexPart part = part_of(vertices, loops);
  for (int i = 0; i < n; ++i)
    if (outline[i].is_cut) {
      part.faces[2 + i].kind = catalog::FaceKind::inner;
      const double sign = part.faces[2 + i].plane.normal[0] > 0 ? 1 : -1;
      part.faces[2 + i].plane = {{sign, 0, 0}, sign * outline[i].x};
    }
  return part;
}

/// The same body cut into slabs of about equally many sides.
std::vector<catalog::ConvexPart> slabs(const Outline& whole) {
  constexpr int kSlabs = 10;
  std::vector<catalog::ConvexPart> parts;
  const auto cut = [](int k) { return -std::cos(std::numbers::pi * k / kSlabs); };
  for (int k = 0; k < kSlabs; ++k) {
    Outline slab = whole;
    if (k > 0) slab = behind(slab, -1, cut(k));
    if (k < kSlabs - 1) slab = behind(slab, 1, cut(k + 1));
    parts.push_back(prism(slab));
  }
  return parts;
}

dem_gpu::Shape shape_of(std::vector<catalog::ConvexPart> parts) {
  double volume = 0;
  for (const catalog::ConvexPart& part : parts) volume += catalog::volume_moments(triangulated(part)).volume;
  return {"", dem_gpu::PolyhedralShape{std::move(parts)}, volume, {}};
}

TEST(FineBody, ForceEqualsAPlainVersion) {
  const Outline outline = ellipse();
  const catalog::ConvexPart whole = prism(outline);
  const dem_gpu::Shape fine = shape_of(slabs(outline));
  for (const catalog::ConvexPart& part : std::get<dem_gpu::PolyhedralShape>(fine.geometry).parts) {
    ASSERT_LE(part.vertex_count(), static_cast<std::size_t>(dem_gpu::kMaxPartVertices));
    ASSERT_LE(part.face_count(), static_cast<std::size_t>(dem_gpu::kMaxPartFaces));
  }
  const double diameter = std::cbrt(6 * fine.volume / std::numbers::pi);
  constexpr double kCap = 1;  // beyond all depths
  const dem_gpu::PolyhedralLaw law = dem_gpu::DepthPotential{1, kCap};
  const Quaternion tilt = dem_gpu::axis_angle({0.6, 0, 0.8}, 0.4);
  struct Case {
    const char* name;
    double edge;
    BodyPose pose;
  };
  // Near the axis all sides are equally far: few faces of the cube have room for all of them.
  for (const Case& one :
       {Case{"small, near the axis", 0.2, {{0.05, 0.02, 0.1}, tilt}},
        Case{"middling, at the axis", 0.9, {{0.01, 0.03, 0.2}, tilt}},
        Case{"large, from below", 1.6, {{0.1, 0.05, -0.9}, tilt}}, Case{"at the side", 0.5, {{0.9, 0.1, 0.2}, tilt}}}) {
    const catalog::ConvexPart cube = dem_gpu::box_part({one.edge, one.edge, one.edge});
    const dem_gpu::Shape box = shape_of({cube});
    const PosePair poses{{}, one.pose};
    const auto found = dem_gpu::OverlapProbe(fine, box, law).contact(poses);
    const auto swapped = dem_gpu::OverlapProbe(box, fine, law).contact({poses.b, poses.a});
    const double cube_diameter = std::cbrt(6 * box.volume / std::numbers::pi);
    const plain::DepthForce exact =
        plain::depth_force({whole, poses.a, kCap * diameter}, {cube, poses.b, kCap * cube_diameter});
    const double size = 1.5 + one.edge;
    std::printf("  %-22s: force off by %.1e, torque by %.1e\n", one.name,
                norm(found.force - exact.force) / exact.weight,
                norm(found.torque_a - exact.torque) / (exact.weight * size));
    EXPECT_LT(norm(found.force - exact.force), kPairGoal * exact.weight) << one.name;
    EXPECT_LT(norm(found.torque_a - exact.torque), kPairGoal * exact.weight * size) << one.name;
    EXPECT_LT(norm(found.force + swapped.force), kPairGoal * exact.weight) << one.name;
  }
}

}  // namespace
