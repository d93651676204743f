// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/laws/laws_cases.h"

namespace workflows {
namespace {

using dem_gpu::OverlapProbe;
using dem_gpu::PosePair;
using dem_gpu::ProbeContact;
using dem_gpu::Shape;
using dem_gpu::Vec3;

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
/// Rounding: of the least depth, 1e-3, by a few 1e-16, in mixed precision by 2e-7 of bodies 3 edges long.
constexpr double kSameForce = dem_gpu::local_tolerance(1e-9, 1e-3);

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
  return {{{"force, worst change", force_change, "-", goal_for(law, at_most(kSameForce)), ""},
           {"torque, worst change", torque_change, "-", goal_for(law, at_most(kSameForce)), ""}},
          {}};
}

}  // namespace

void add_cut_cases(BenchPlan& plan, const NamedLaw& law) {
  for (const CutComparison& cuts : cut_comparisons())
    plan.cases.push_back({cuts.name + "-" + law.name, [cuts, law] { return measure_cuts(cuts, law); }});
}

}  // namespace workflows
