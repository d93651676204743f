// SPDX-License-Identifier: Apache-2.0
#pragma once

// The laws bench: the laws of polyhedra against each other. What its cases share, and their plans.

#include <optional>
#include <string>
#include <vector>

#include "dem_gpu/overlap_probe.h"
#include "workflows/bench/bench_plan.h"

namespace workflows {

struct NamedLaw {
  std::string name;
  dem_gpu::PolyhedralLaw law;
  bool is_gradient;  // goals are set for laws that are the gradient of an energy
};

/// The laws at equal stiffness, flat on flat.
const std::vector<NamedLaw>& compared_laws();

/// The goal for a law that is a gradient, none for others.
std::optional<Goal> goal_for(const NamedLaw& law, Goal goal);

dem_gpu::Quaternion turned(const dem_gpu::Vec3& axis, double degrees);

// Each adds its cases for one law.

/// Net work round closed paths of slides and turns in contact.
void add_path_cases(BenchPlan& plan, const NamedLaw& law);
/// Forces on one body cut in several ways.
void add_cut_cases(BenchPlan& plan, const NamedLaw& law);
/// Continuity as a second face touches; growth of the force with depth; how deep face, edge and corner land.
void add_stiffness_cases(BenchPlan& plan, const NamedLaw& law);
/// Time a touching pair.
void add_cost_cases(BenchPlan& plan, const NamedLaw& law);

/// The depth potential at several depth caps: what a cap costs and what it keeps apart.
void add_cap_cases(BenchPlan& plan);

/// Net work on b round a path that is b's centre and swing against a, over the range the work goes through.
struct PathWork {
  double share;
  double swing;  // that range [J]
};
/// Of a corner of a cross drawn across a rough rock, over ridges and pits.
PathWork rough_path_work(const dem_gpu::PolyhedralLaw& law);

/// Time to find the contact of one touching pair at random attitudes, up to 1 % of a metre deep, the fastest of a few
/// sweeps [s].
double time_per_pair(const dem_gpu::Shape& a, const dem_gpu::Shape& b, const dem_gpu::PolyhedralLaw& law);

}  // namespace workflows
