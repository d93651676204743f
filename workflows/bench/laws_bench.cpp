// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/cpu_clock.h"

namespace workflows {
namespace {

using dem_gpu::axis_angle;
using dem_gpu::BodyPose;
using dem_gpu::DepthPotential;
using dem_gpu::HardeningDepthPotential;
using dem_gpu::OverlapProbe;
using dem_gpu::OverlapVolume;
using dem_gpu::PolyhedralLaw;
using dem_gpu::PosePair;
using dem_gpu::ProbeContact;
using dem_gpu::Quaternion;
using dem_gpu::Shape;
using dem_gpu::Vec3;

struct NamedLaw {
  std::string name;
  PolyhedralLaw law;
  bool is_gradient;  // goals are set for laws that are the gradient of an energy
};

// Flat on flat, F = 2 k A d for the depth potential and k A d for the volume law: equal stiffness at these constants.
// The hardening law is twice as stiff at 1 % of a cube's edge.
const double kCubeDiameter = std::cbrt(6 / std::numbers::pi);
const std::vector<NamedLaw> kLaws{
    {"depth", DepthPotential{0.5}, true},
    {"hardening", HardeningDepthPotential{DepthPotential{0.5}, 0.01 / kCubeDiameter}, true},
    {"volume", OverlapVolume{1}, false}};

std::optional<Goal> goal_for(const NamedLaw& law, Goal goal) {
  return law.is_gradient ? std::optional<Goal>(goal) : std::nullopt;
}

Quaternion turned(const Vec3& axis, double degrees) { return axis_angle(axis, degrees * std::numbers::pi / 180); }

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

struct PathWork {
  double share;  // net work over the range the work went through
  double swing;  // that range [J]
};

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
      // A corner of a cross drawn across a rough rock, over ridges and pits.
      {"rock-on-cross",
       rough_rock_shape(),
       cross_shape(5),
       {},
       {1.6, 0.3, 0.4},
       0.15 * z,
       0.12 * x,
       turned({0.6, 0, 0.8}, 25),
       y,
       0.2},
  };
}

CaseResult measure_path(const ClosedPath& path, const NamedLaw& law) {
  const PathWork work = path_work(path, law.law);
  return {{{"net work over the swing of energy", work.share, "-", goal_for(law, at_most(1e-5)), ""},
           {"swing of energy", work.swing, "J", {}, ""}},
          {}};
}

// Cuts.

struct CutComparison {
  std::string name;
  Shape whole, cut, partner;
};

std::vector<CutComparison> cut_comparisons() {
  const Vec3 unit{1, 1, 1};
  const Shape cube = box_shape(unit);
  return {{"cuts-cube-2", cube, cut_box_shape(unit, {2, 1, 1}), cube},
          {"cuts-cube-8", cube, cut_box_shape(unit, {2, 2, 2}), cube},
          {"cuts-both-8", cube, cut_box_shape(unit, {2, 2, 2}), cut_box_shape(unit, {2, 2, 2})},
          {"cuts-L-2-3", l_shape(2), l_shape(3), cube},
          {"cuts-L-on-L", l_shape(2), l_shape(3), l_shape(3)},
          {"cuts-cross-3-5", cross_shape(3), cross_shape(5), cube},
          {"cuts-rock-on-cross", cross_shape(3), cross_shape(5), rough_rock_shape()}};
}

constexpr int kCutPoses = 2000;

/// Worst change of force and torque between two cuts of one body, over random contacts up to 5 % of an edge deep, as a
/// share of the whole body's force, and of that force times an edge.
CaseResult measure_cuts(const CutComparison& cuts, const NamedLaw& law) {
  const OverlapProbe whole(cuts.whole, cuts.partner, law.law), cut(cuts.cut, cuts.partner, law.law);
  std::mt19937_64 random(7);
  double force_change = 0, torque_change = 0;
  int touching = 0;
  while (touching < kCutPoses) {
    PosePair poses{{{}, random_rotation(random)}, {{}, random_rotation(random)}};
    const Vec3 direction = random_direction(random);
    const double depth = uniform(random, 1e-3, 0.05);
    poses.b.position = (touch_distance(whole, poses, direction, 4) - depth) * direction;
    const ProbeContact reference = whole.contact(poses), other = cut.contact(poses);
    const double force = norm(reference.force);
    // Grazing pairs have forces of rounding size; a millionth of a flat contact's is the least looked at.
    if (!(force > 1e-6 * depth)) continue;
    ++touching;
    force_change = std::max(force_change, norm(other.force - reference.force) / force);
    torque_change = std::max(torque_change, norm(other.torque_a - reference.torque_a) / force);
  }
  return {{{"force, worst change", force_change, "-", goal_for(law, at_most(1e-9)), ""},
           {"torque, worst change", torque_change, "-", goal_for(law, at_most(1e-9)), ""}},
          {}};
}

// Continuity: a second flat face touches while the first ones bear.

/// Jump of the force as the bridge between two posts comes down on a plate, by the change from just before to just
/// after, the change over as much before taken off.
CaseResult measure_second_face(const NamedLaw& law) {
  const OverlapProbe probe(box_shape({4, 4, 1}), bridge_shape(), law.law);
  const auto force = [&](double depth) { return norm(probe.contact({{}, {{0, 0, 1 - depth}}}).force); };
  constexpr double kTouch = 0.02, kStep = 1e-7;
  const double after = force(kTouch + kStep) - force(kTouch), before = force(kTouch) - force(kTouch - kStep);
  return {{{"jump of the force", std::abs(after - before) / force(kTouch), "-", goal_for(law, at_most(1e-4)), ""}}, {}};
}

// Stiffness: how deep face, edge and corner land, and how F grows.

struct Attitude {
  std::string name;
  Quaternion orientation;
  double height;    // of the cube's centre above the block when they touch [m]
  double exponent;  // of a law that is linear face on face: flat, edge, corner
};

std::vector<Attitude> attitudes() {
  const Quaternion corner =
      turned({0, 1, 0}, std::atan(std::sqrt(2.0)) * 180 / std::numbers::pi) * turned({0, 0, 1}, 45);
  return {
      {"face", {}, 0.5, 1}, {"edge", turned({1, 0, 0}, 45), std::sqrt(0.5), 2}, {"corner", corner, std::sqrt(0.75), 3}};
}

/// A cube landing on a wide block without turning.
class Landing {
 public:
  Landing(const Attitude& attitude, const NamedLaw& law)
      : probe_(box_shape({10, 10, 2}), box_shape({1, 1, 1}), law.law), attitude_(attitude) {}

  double force(double depth) const {
    return norm(probe_.contact({{}, {{0, 0, 1 + attitude_.height - depth}, attitude_.orientation}}).force);
  }
  struct Impact {
    double depth, time;  // largest overlap, of the whole contact
  };
  /// Velocity Verlet of a mass at unit speed, elastic.
  Impact impact(double mass) const {
    const double step = 2e-4 * std::numbers::pi * std::sqrt(mass);  // of a flat contact
    double depth = 0, speed = 1, acceleration = 0, time = 0;
    while (speed > 0) {
      speed -= step / 2 * acceleration;
      depth += step * speed;
      acceleration = force(depth) / mass;
      speed -= step / 2 * acceleration;
      time += step;
    }
    return {depth, 2 * time};
  }

 private:
  OverlapProbe probe_;
  Attitude attitude_;
};

/// Overlaps of face, edge and corner of one cube at one impact, at which the face sinks in by 1 % of the edge with the
/// linear law.
CaseResult measure_landing(const NamedLaw& law) {
  constexpr double kFaceOverlap = 0.01;
  constexpr double kMass = kFaceOverlap * kFaceOverlap;  // 1/2 m v^2 = 1/2 d^2 at v = 1 and unit stiffness
  CaseResult result;
  double face = 0;
  for (const Attitude& attitude : attitudes()) {
    const Landing::Impact impact = Landing(attitude, law).impact(kMass);
    if (face == 0) face = impact.depth;
    result.figures.push_back({attitude.name + ", overlap", impact.depth, "edge", {}, ""});
    result.figures.push_back({attitude.name + ", overlap over that of the face", impact.depth / face, "-", {}, ""});
    result.figures.push_back({attitude.name + ", contact time", impact.time, "s", {}, ""});
  }
  return result;
}

CaseResult measure_exponent(const Attitude& attitude, const NamedLaw& law) {
  const Landing landing(attitude, law);
  PlotCurve curve{"force", law.name + ", " + attitude.name, {}, {}, {}};
  for (double depth = 1e-4; depth < 0.05; depth *= 2) {
    curve.x.push_back(depth);
    curve.y.push_back(landing.force(depth));
    curve.point_names.push_back("depth " + std::to_string(depth));
  }
  // Slope over the range a run works in: up to 1 % of the edge.
  const auto last =
      static_cast<std::size_t>(std::upper_bound(curve.x.begin(), curve.x.end(), 0.01) - curve.x.begin() - 1);
  const double slope = std::log(curve.y[last] / curve.y[0]) / std::log(curve.x[last] / curve.x[0]);
  return {{{"n in F ~ depth^n", slope, "-", {}, ""},
           {"n, distance from that of the linear law", std::abs(slope - attitude.exponent), "-",
            law.name == "depth" ? std::optional<Goal>(at_most(0.02)) : std::nullopt, ""}},
          {curve}};
}

// Cost.

struct CostPair {
  std::string name;
  Shape a, b;
};

constexpr int kCostPairs = 500;
constexpr int kCostSweeps = 5;

/// Touching pairs at random attitudes, up to 1 % of a metre deep; the fastest of a few sweeps.
CaseResult measure_cost(const CostPair& shapes, const NamedLaw& law) {
  const OverlapProbe probe(shapes.a, shapes.b, law.law);
  std::mt19937_64 random(11);
  std::vector<PosePair> pairs;
  for (int i = 0; i < kCostPairs; ++i) {
    PosePair pair{{{}, random_rotation(random)}, {{}, random_rotation(random)}};
    const Vec3 direction = random_direction(random);
    pair.b.position = (touch_distance(probe, pair, direction, 5) - uniform(random, 1e-4, 0.01)) * direction;
    pairs.push_back(pair);
  }
  dem_gpu::SeparationCache cache;
  probe.count_contacts(pairs, cache);  // fills the cache
  double fastest = std::numeric_limits<double>::max();
  for (int sweep = 0; sweep < kCostSweeps; ++sweep) {
    const CpuClock clock;
    probe.count_contacts(pairs, cache);
    fastest = std::min(fastest, clock.seconds());
  }
  return {{{"time a pair of bodies", 1e9 * fastest / kCostPairs, "ns", {}, ""}}, {}};
}

}  // namespace

BenchPlan plan_laws_bench(const BenchOptions&) {
  const Shape cube = box_shape({1, 1, 1});
  const std::vector<CostPair> cost_pairs{{"cost-cube", cube, cube},
                                         {"cost-L", l_shape(3), l_shape(3)},
                                         {"cost-cross", cross_shape(5), cross_shape(5)},
                                         {"cost-rock", rough_rock_shape(), rough_rock_shape()}};
  BenchPlan plan;
  for (const NamedLaw& law : kLaws) {
    for (const ClosedPath& path : closed_paths())
      plan.cases.push_back({path.name + "-" + law.name, [path, law] { return measure_path(path, law); }});
    for (const CutComparison& cuts : cut_comparisons())
      plan.cases.push_back({cuts.name + "-" + law.name, [cuts, law] { return measure_cuts(cuts, law); }});
    plan.cases.push_back({"second-face-" + law.name, [law] { return measure_second_face(law); }});
    for (const Attitude& attitude : attitudes())
      plan.cases.push_back(
          {"exponent-" + attitude.name + "-" + law.name, [attitude, law] { return measure_exponent(attitude, law); }});
    plan.cases.push_back({"landing-" + law.name, [law] { return measure_landing(law); }});
    for (const CostPair& shapes : cost_pairs)
      plan.cases.push_back({shapes.name + "-" + law.name, [shapes, law] { return measure_cost(shapes, law); }});
  }
  plan.plots = {{"force", "Cube of edge 1 m on a wide block, flat stiffness 1 N/m3", "depth [m]", "force [N]"}};
  return plan;
}

}  // namespace workflows
