// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/benchmark/scenes/speed_scenes.h"
#include "workflows/bench/bench_plan.h"

namespace workflows {

// What a scene of the bench `speed` is asked for.
struct SpeedGoal {
  double step_time;  // at most, where LIGGGHTS takes kReferenceStepTime on S1 [ms]
};

/// Time of a step with its spread, contacts, overlaps, energy error, memory and the speed-up by a second thread.
CaseResult measure_speed(const std::string& scene, benchmark_scenes::Law law, const SpeedGoal& goal);

/// CPU seconds that a simulated second of S4 takes at a worst overlap of 4 % and a mean of 0.2 % of size.
CaseResult measure_simulated_second();

/// Markdown: a row a scene, then all figures.
std::string speed_page(const std::vector<ReportedFigure>& figures);

// Names of figures that the page looks up.
inline constexpr char kStepTime[] = "time a step, median of 3 windows";
inline constexpr char kStepTimeLeast[] = "time a step, fastest window";
inline constexpr char kStepTimeLargest[] = "time a step, slowest window";
inline constexpr char kParticleSteps[] = "particle-steps a second";
inline constexpr char kCoordination[] = "contacts of a particle";
inline constexpr char kEnergyError[] = "energy imbalance over energy put in, while bodies fall on each other";
inline constexpr char kAllocated[] = "memory of the run";
inline constexpr char kSpeedUp[] = "two threads over one";
inline constexpr char kRatio[] = "time over LIGGGHTS on S1 box";

}  // namespace workflows
