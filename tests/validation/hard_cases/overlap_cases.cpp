// SPDX-License-Identifier: Apache-2.0
// One pair of bodies in one pose: what the narrow phase must get right.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "catalog/input_error.h"
#include "dem_gpu/overlap_probe.h"
#include "tests/support/dem_scenes.h"
#include "tests/support/precision.h"
#include "tests/validation/hard_cases/hard_case.h"

namespace hard_cases {
namespace {

using namespace test_support;
using dem_gpu::OverlapProbe;
using dem_gpu::PosePair;

const dem_gpu::DepthPotential kLaw{0.5};  // a flat face then pushes with area times depth

OverlapProbe cubes() {
  return {dem_gpu::polyhedral_shape("cube", {unit_cube()}), dem_gpu::polyhedral_shape("cube", {unit_cube()}), kLaw};
}

Vec3 column(const dem_gpu::Mat3& m, int axis) { return axis == 0 ? m.column_x : axis == 1 ? m.column_y : m.column_z; }
Real component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Largest gap of two boxes over the 15 separating axes (Gottschalk, Lin & Manocha, SIGGRAPH 1996): negative where they
/// overlap.
Real box_gap(const std::array<Vec3, 2>& half, const std::array<Quaternion, 2>& turn, const Vec3& offset) {
  const dem_gpu::Mat3 axes[2] = {rotation_matrix(turn[0]), rotation_matrix(turn[1])};
  Real largest = -std::numeric_limits<Real>::max();
  const auto try_axis = [&](const Vec3& axis) {
    const Real length = norm(axis);
    if (length < 1e-6) return;
    Real reach = 0;
    for (int body = 0; body < 2; ++body)
      for (int k = 0; k < 3; ++k)
        reach += component(half[static_cast<std::size_t>(body)], k) * std::abs(dot(axis, column(axes[body], k)));
    largest = std::max(largest, (std::abs(dot(axis, offset)) - reach) / length);
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(column(axes[0], i));
    try_axis(column(axes[1], i));
    for (int j = 0; j < 3; ++j) try_axis(cross(column(axes[0], i), column(axes[1], j)));
  }
  return largest;
}

Finding random_boxes() {
  const Vec3 halves[] = {{0.04, 0.04, 0.04}, {0.08, 0.08, 0.004}, {0.002, 0.002, 0.09}, {0.05, 0.02, 0.03}};
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> along(-0.1, 0.1);
  int missed = 0, phantom = 0, touching = 0, pairs = 0;
  Real asymmetry = 0;
  for (const Vec3& a : halves)
    for (const Vec3& b : halves) {
      const OverlapProbe probe(box_shape(2 * a), box_shape(2 * b), kLaw);
      const OverlapProbe mirrored(box_shape(2 * b), box_shape(2 * a), kLaw);
      for (int i = 0; i < 1000; ++i, ++pairs) {
        const std::array<Quaternion, 2> turn{random_rotation(random), random_rotation(random)};
        const Vec3 offset{along(random), along(random), along(random)};
        const Real gap = box_gap({a, b}, turn, offset);
        if (std::abs(gap) < 1e-9 + 0.2 * kSingle.position) continue;  // rounding decides
        const dem_gpu::BodyPose pose_a{{}, turn[0]}, pose_b{offset, turn[1]};
        const Real volume = probe.overlap({pose_a, pose_b}).volume;
        touching += gap < 0;
        // A slab right through a box is pushed equally from both sides: there the force may vanish.
        const bool is_through = -gap > 2 * std::min({a.x, a.y, a.z, b.x, b.y, b.z});
        missed += gap < 0 && !(volume > 0 && (is_through || norm(probe.contact({pose_a, pose_b}).force) > 0));
        phantom += gap > 0 && volume > 0;
        const Real smaller = 8 * std::min(a.x * a.y * a.z, b.x * b.y * b.z);
        asymmetry = std::max(asymmetry, std::abs(volume - mirrored.overlap({pose_b, pose_a}).volume) / smaller);
      }
    }
  return {missed == 0 && phantom == 0 && asymmetry < 1e-12 + kSingle.relative && touching > 1000,
          text("%d pairs, %d touch: %d missed, %d phantom, V(A,B) - V(B,A) %.0e of the smaller box", pairs, touching,
               missed, phantom, double(asymmetry))};
}

Finding cube_symmetries() {
  const OverlapProbe probe = cubes();
  const PosePair reference{{}, {{0.1, 0.2, 0.95}, {}}};
  const auto expected = probe.contact(reference);
  Real worst_volume = 0, worst_force = 0;
  int count = 0;
  for (int axis = 0; axis < 6; ++axis)
    for (int quarter = 0; quarter < 4; ++quarter, ++count) {
      const Vec3 up = (axis % 2 ? -1 : 1) * (axis / 2 == 0   ? Vec3{1, 0, 0}
                                             : axis / 2 == 1 ? Vec3{0, 1, 0}
                                                             : Vec3{0, 0, 1});
      PosePair turned = reference;
      turned.b.orientation = turn_between({0, 0, 1}, up) * dem_gpu::axis_angle({0, 0, 1}, quarter * M_PI / 2);
      worst_volume = std::max(worst_volume, std::abs(probe.overlap(turned).volume - 0.9 * 0.8 * 0.05));
      worst_force = std::max(worst_force, norm(probe.contact(turned).force - expected.force) / norm(expected.force));
    }
  return {worst_volume < 1e-14 + kSingle.position && worst_force < 1e-12 + kSingle.integral,
          text("%d turns: V off by %.0e, force by %.0e", count, double(worst_volume), double(worst_force))};
}

/// Cube on cube 0.001 deep, the upper turned by `angle` about x: the tilted bottom sinks in as a slab, or beyond
/// h / 0.5 as a wedge of height h + 0.5 tan(angle).
Finding near_aligned() {
  const OverlapProbe probe = cubes();
  Real worst = 0, worst_tilt = 0;
  for (Real angle = 1e-9; angle < 2e-2; angle *= 10) {
    const PosePair poses{{}, {{0, 0, 0.999}, dem_gpu::axis_angle({1, 0, 0}, angle)}};
    const Real height = 0.001 + 0.5 * (1 / std::cos(angle) - 1), slope = std::tan(angle);
    const Real deep = height + slope / 2;
    const Real expected = slope / 2 < height ? height : deep * deep / (2 * slope);
    // What the rounded picture leaves out: the sides tilt by the angle.
    worst = std::max(
        worst, std::abs(probe.overlap(poses).volume / expected - 1) / (2 * angle + 1e-9 + kSingle.position / 0.001));
    const Vec3 force = probe.contact(poses).force;
    worst_tilt = std::max(worst_tilt, std::hypot(force.x, force.y) / std::abs(force.z) / (angle + 1e-15));
  }
  return {worst < 1 && worst_tilt < 1.1, text("V within %.2f of 2 angle + %s, normal within %.2f angle", double(worst),
                                              by_precision("1e-9", "2e-4"), double(worst_tilt))};
}

Finding shallow_overlap() {
  const auto contact = cubes().contact({{}, {{0, 0, 1 - 7e-8}, {}}});
  return {std::abs(contact.depth - 7e-8) < 7e-14 + kSingle.position &&
              std::abs(contact.force.z + 7e-8) < 7e-14 + kSingle.position,
          text("depth %.8g, force %.8g", double(contact.depth), double(-contact.force.z))};
}

/// Slabs of thickness t, centres s < t/2 apart: each field's nearest face is now the far one, F = 2 k A s outwards.
Finding thin_boxes() {
  const Real t = 0.008, s = 0.3 * t, area = 0.16 * 0.16;
  const dem_gpu::Shape slab = box_shape({0.16, 0.16, t});
  const auto contact = OverlapProbe(slab, slab, kLaw).contact({{}, {{0, 0, s}, {}}});
  const Real share = -contact.force.z / (area * s);
  // The fields near the side faces are lower: a frame of width s of the perimeter.
  return {share > 0.9 && share < 1, text("force apart %.4f of 2 k A s", double(share))};
}

Finding concentric_boxes() {
  const OverlapProbe same = cubes();
  const OverlapProbe inside(box_shape({1, 1, 1}), box_shape({0.2, 0.3, 0.4}), kLaw);
  const PosePair inner{{}, {{0.1, -0.2, 0.05}, dem_gpu::axis_angle({0.6, 0, 0.8}, 0.7)}};
  const Real whole = same.overlap({}).volume, part = inside.overlap(inner).volume;
  return {std::abs(whole - 1) < 1e-12 + kSingle.integral && std::abs(part - 0.024) < 1e-14 + kSingle.position,
          text("V - 1 = %.0e, V - 0.024 = %.0e", double(whole - 1), double(part - 0.024))};
}

Finding edges() {
  const OverlapProbe probe = cubes();
  const Real d = 0.01;
  const PosePair on_face{{}, {{0, 0, 0.5 + std::sqrt(0.5) - d}, edge_down()}};
  const PosePair crossed{{{}, edge_down()}, {{0, 0, 1.4}, dem_gpu::axis_angle({0, 1, 0}, M_PI / 4)}};
  const Real crossed_depth = std::sqrt(2.0) - 1.4;
  const Real face_error = probe.overlap(on_face).volume / (d * d) - 1;
  const Real crossed_error =
      probe.overlap(crossed).volume / (2 * crossed_depth * crossed_depth * crossed_depth / 3) - 1;
  const auto contact = probe.contact(on_face);
  const Real depth_error = contact.depth / d - 1,
             tilt = std::hypot(contact.force.x, contact.force.y) / norm(contact.force);
  return {std::abs(face_error) < 1e-10 + kSingle.relative && std::abs(crossed_error) < 1e-10 + kSingle.relative &&
              std::abs(depth_error) < 0.02 && tilt < 1e-12 + kSingle.integral,
          text("V off by %.0e and %.0e, depth by %.0e, normal by %.0e rad", double(face_error), double(crossed_error),
               double(depth_error), double(tilt))};
}

Finding degenerate_hulls() {
  using catalog::ConvexPart;
  std::vector<std::vector<ConvexPart>> bad;
  ConvexPart open = unit_cube(), inverted = unit_cube(), dented = unit_cube();
  open.faces.pop_back();
  for (catalog::ConvexFace& face : inverted.faces) {
    std::reverse(face.vertices.begin(), face.vertices.end());
    face.plane = {{-face.plane.normal[0], -face.plane.normal[1], -face.plane.normal[2]}, -face.plane.offset};
  }
  dented.vertices[0] = {0.2, 0.2, 0.2};
  std::mt19937 random(5);
  bad = {{},
         {open},
         {inverted},
         {dented},
         {dem_gpu::box_part({1, 1, 1e-12})},
         {dem_gpu::box_part({1, 1, 0})},
         {part_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})},
         {unit_cube(), moved_part(unit_cube(), {}, {0.5, 0, 0})},
         {random_convex_part(random, dem_gpu::kMaxPartVertices + 1)}};
  int refused = 0;
  for (const auto& parts : bad) {
    try {
      dem_gpu::polyhedral_shape("bad", parts);
    } catch (const catalog::InputError&) {
      ++refused;
    }
  }
  return {refused == static_cast<int>(bad.size()), text("%d of %zu refused by name", refused, bad.size())};
}

}  // namespace

std::vector<HardCase> overlap_cases() {
  return {{"random boxes, slabs, needles",
           by_precision("no contact missed, none made up (15 axes), V symmetric to 1e-12",
                        "no contact missed, none made up (15 axes), V symmetric to 1e-4"),
           true, random_boxes},
          {"24 symmetries of the cube", by_precision("V to 1e-14, force to 1e-12", "V to 2e-7, force to 2e-6"), true,
           cube_symmetries},
          {"faces parallel to 1e-9 .. 1e-2 rad",
           by_precision("V to 2 angle, normal to 1.1 angle", "V to 2 angle + 2e-4, normal to 1.1 angle"), true,
           near_aligned},
          {"overlap of 7e-8 of the size",
           by_precision("depth and force to 1e-6", "depth and force to 2e-7 of the size"), true, shallow_overlap},
          {"thin boxes past half thickness", "pushed apart, 0.9 .. 1 of 2 k A s", true, thin_boxes},
          {"concentric and contained boxes", by_precision("V exact", "V to 2e-6"), true, concentric_boxes},
          {"edge on face, crossed edges",
           by_precision("V to 1e-10, normal to 1e-12, depth (for damping and output) to 2 %",
                        "V to 1e-4, normal to 2e-6, depth (for damping and output) to 2 %"),
           true, edges},
          {"degenerate hulls", "every one refused by name", true, degenerate_hulls}};
}

}  // namespace hard_cases
