// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "workflows/bench/bench_plan.h"

namespace workflows {

// How the time of a particle in a step grows with what a scene has more of.

CaseResult measure_number(const std::string& scene);  // of bodies: "s1-box" or "s2"
CaseResult measure_size_ratio();                      // of spheres: 1 to 30
CaseResult measure_parts();                           // of a cube: 1 to 27
CaseResult measure_faces();                           // of a ball: 12 to 120
CaseResult measure_contacts();                        // of a sphere: less than 1 to 7 or so
CaseResult measure_triangles();                       // of the floor: 2 to 200,000

/// What each feature costs when it is on, and the passes that it adds.
CaseResult measure_features();

}  // namespace workflows
