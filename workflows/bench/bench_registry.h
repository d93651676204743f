// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "workflows/bench/bench_plan.h"

namespace workflows {

struct Bench {
  std::string name;
  std::string summary;
  BenchPlan (*plan)(const BenchOptions&);  // cheap: nothing is measured before a case is run
};

/// All benches that `talus bench NAME` knows.
const std::vector<Bench>& benches();

/// Throws catalog::UsageError with a suggestion for an unknown name.
const Bench& bench_named(const std::string& name);

// One function a bench, in the file of its name.
BenchPlan plan_box_bench(const BenchOptions& options);
BenchPlan plan_bulk_bench(const BenchOptions& options);
BenchPlan plan_contact_bench(const BenchOptions& options);
BenchPlan plan_decomposition_bench(const BenchOptions& options);  // where decomposition and shape_pipeline are built
BenchPlan plan_digitize_bench(const BenchOptions& options);       // likewise
BenchPlan plan_growth_bench(const BenchOptions& options);
BenchPlan plan_impacts_bench(const BenchOptions& options);
BenchPlan plan_laws_bench(const BenchOptions& options);
BenchPlan plan_levels_bench(const BenchOptions& options);
inline constexpr char kHandOutlines[] = "ampis_powder_particle_polygons.json";  // that the bench micrographs scores by
BenchPlan plan_micrographs_bench(const BenchOptions& options);                  // where shape_pipeline is built
BenchPlan plan_overlap_bench(const BenchOptions& options);
BenchPlan plan_parts_bench(const BenchOptions& options);
BenchPlan plan_pile_bench(const BenchOptions& options);
BenchPlan plan_speed_bench(const BenchOptions& options);
BenchPlan plan_walls_bench(const BenchOptions& options);

}  // namespace workflows
