// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/laws/laws_cases.h"

namespace workflows {
namespace {

using dem_gpu::axis_angle;
using dem_gpu::BodyPose;
using dem_gpu::OverlapProbe;
using dem_gpu::PolyhedralLaw;
using dem_gpu::PosePair;
using dem_gpu::ProbeContact;
using dem_gpu::Quaternion;
using dem_gpu::Shape;
using dem_gpu::Vec3;

// Closed paths: body b goes round an ellipse while it swings about an axis; a stands still.

struct ClosedPath {
  std::string name;
  Shape a, b;
  BodyPose fixed;       // a
  Vec3 centre;          // of b's ellipse [m]
  Vec3 cosine, sine;    // half-axes [m]
  Quaternion attitude;  // of b at rest
  Vec3 swing_axis;      // unit, through b's origin
  double swing = 0;     // amplitude [rad], twice as fast as the ellipse
};

/// Of the swing against the ellipse: no path is its own mirror image, or any law would come out even.
constexpr double kSwingPhase = 1;
/// Enough for the error of the sum to stay ten times below the goal where flat faces meet at once.
constexpr int kPathSteps = 40000;

/// Net work on b round the path: trapezium rule, of high order on a smooth closed path.
PathWork path_work(const ClosedPath& path, const PolyhedralLaw& law) {
  const OverlapProbe probe(path.a, path.b, law);
  double work = 0, least = 0, largest = 0;
  for (int i = 0; i < kPathSteps; ++i) {
    const double s = 2 * std::numbers::pi * (i + 0.5) / kPathSteps;
    const Vec3 position = path.centre + std::cos(s) * path.cosine + std::sin(s) * path.sine;
    const BodyPose pose{position,
                        axis_angle(path.swing_axis, path.swing * std::sin(2 * s + kSwingPhase)) * path.attitude};
    const ProbeContact contact = probe.contact({path.fixed, pose});
    const Vec3 speed = std::cos(s) * path.sine - std::sin(s) * path.cosine;  // d position / ds
    // On b: the opposite force; the torque about b's origin follows from the one about a's.
    const Vec3 torque_b = cross(pose.position - path.fixed.position, contact.force) - contact.torque_a;
    const double turning = 2 * path.swing * std::cos(2 * s + kSwingPhase) * dot(torque_b, path.swing_axis);
    work += (turning - dot(contact.force, speed)) * 2 * std::numbers::pi / kPathSteps;
    least = std::min(least, work);
    largest = std::max(largest, work);
  }
  return {largest > least ? std::abs(work) / (largest - least) : 0, largest - least};
}

/// A corner of a cross drawn across a rough rock, over ridges and pits.
ClosedPath rough_path() {
  return {"rock-on-cross",      rough_rock_shape(),        cross_shape(5), {}, {1.6, 0.3, 0.4}, 0.15 * Vec3{0, 0, 1},
          0.12 * Vec3{1, 0, 0}, turned({0.6, 0, 0.8}, 25), Vec3{0, 1, 0},  0.2};
}

std::vector<ClosedPath> closed_paths() {
  const Shape cube = box_shape({1, 1, 1});
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Quaternion level;
  const double edges = std::sqrt(2.0);  // height at which crossed edges touch
  return {
      // Flat on flat, 2 % deep, out over the edge and back above.
      {"face-slide", cube, cube, {}, {0.7, 0.1, 1.04}, 0.7 * x, 0.06 * z, level, y, 0},
      // The same with the upper cube rocking.
      {"face-rock", cube, cube, {}, {0.7, 0.1, 1.06}, 0.7 * x, 0.08 * z, level, y, 0.05},
      // Crossed edges: in, along, turning, out.
      {"edge-edge",
       cube,
       cube,
       {{}, turned(x, 45)},
       {0.05, 0.1, edges + 0.02},
       0.1 * x,
       0.08 * z,
       turned(y, 45),
       z,
       0.4},
      // A vertex ploughs over a face and its edge.
      {"vertex-face",
       cube,
       cube,
       {},
       {0.4, 0.2, 1.38},
       0.4 * x,
       0.1 * z,
       turned(x, 45) * turned(y, 35.26438968),
       y,
       0.2},
      // A cube drawn round the inner corner of an L.
      {"inner-corner",
       l_shape(3),
       box_shape({0.8, 0.8, 0.8}),
       {},
       {0.42, 0.42, 0.3},
       0.06 * x,
       0.06 * y,
       turned(z, 3),
       z,
       0.05},
      // Its edge first, into the inner corner and about.
      {"inner-corner-edge",
       l_shape(2),
       box_shape({0.5, 0.5, 0.5}),
       {},
       {0.38, 0.38, 0.2},
       0.06 * (x + y),
       0.05 * (x - y),
       turned({0.6, 0, 0.8}, 40),
       y,
       0.1},
      // A notch of a cross over the edge of a cube.
      {"notch-on-cube",
       cross_shape(3),
       cube,
       {},
       {0.99, 0.99, 0.15},
       0.05 * x,
       0.05 * y,
       turned({0.6, 0.8, 0}, 10),
       z,
       0.1},
      rough_path(),
  };
}

CaseResult measure_path(const ClosedPath& path, const NamedLaw& law) {
  const PathWork work = path_work(path, law.law);
  return {{{"net work over the swing of energy", work.share, "-", goal_for(law, at_most(1e-5)), ""},
           {"swing of energy", work.swing, "J", {}, ""}},
          {}};
}

}  // namespace

PathWork rough_path_work(const dem_gpu::PolyhedralLaw& law) { return path_work(rough_path(), law); }

void add_path_cases(BenchPlan& plan, const NamedLaw& law) {
  for (const ClosedPath& path : closed_paths())
    plan.cases.push_back({path.name + "-" + law.name, [path, law] { return measure_path(path, law); }});
}

}  // namespace workflows
