// SPDX-License-Identifier: Apache-2.0
// How the time of a particle in a step grows with what a scene has more of, and what each feature costs.
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/growth/growth_cases.h"

namespace workflows {

BenchPlan plan_growth_bench(const BenchOptions&) {
  BenchPlan plan;
  plan.cases = {{"spheres", [] { return measure_number("s1-box"); }},
                {"polyhedra", [] { return measure_number("s2"); }},
                {"size-ratio", measure_size_ratio},
                {"parts", measure_parts},
                {"faces", measure_faces},
                {"contacts", measure_contacts},
                {"triangles", measure_triangles},
                {"features", measure_features}};
  const std::string time = "time of a particle in a step [ns]";
  plan.plots = {{"number", "Beds of the same depth", "bodies [-]", time},
                {"ratio", "Two sizes of spheres", "ratio of diameters [-]", time},
                {"parts", "Cubes cut into parts", "parts of a cube [-]", time},
                {"faces", "Faceted balls", "faces of a part [-]", time},
                {"contacts", "Spheres a little smaller or larger", "contacts of a particle [-]", time},
                {"triangles", "The floor as a mesh", "triangles [-]", time}};
  return plan;
}

}  // namespace workflows
