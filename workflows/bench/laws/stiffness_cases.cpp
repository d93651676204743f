// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/laws/laws_cases.h"

namespace workflows {
namespace {

using dem_gpu::OverlapProbe;
using dem_gpu::Quaternion;

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

}  // namespace

void add_stiffness_cases(BenchPlan& plan, const NamedLaw& law) {
  plan.cases.push_back({"second-face-" + law.name, [law] { return measure_second_face(law); }});
  for (const Attitude& attitude : attitudes())
    plan.cases.push_back(
        {"exponent-" + attitude.name + "-" + law.name, [attitude, law] { return measure_exponent(attitude, law); }});
  plan.cases.push_back({"landing-" + law.name, [law] { return measure_landing(law); }});
}

}  // namespace workflows
