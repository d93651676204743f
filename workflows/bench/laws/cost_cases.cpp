// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <random>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/laws/laws_cases.h"

namespace workflows {
namespace {

using dem_gpu::PosePair;
using dem_gpu::Shape;

constexpr int kPairs = 500;
constexpr int kSweeps = 5;

struct CostPair {
  std::string name;
  Shape a, b;
};

}  // namespace

double time_per_pair(const Shape& a, const Shape& b, const dem_gpu::PolyhedralLaw& law) {
  const dem_gpu::OverlapProbe probe(a, b, law);
  std::mt19937_64 random(11);
  std::vector<PosePair> pairs;
  for (int i = 0; i < kPairs; ++i) {
    PosePair pair{{{}, random_rotation(random)}, {{}, random_rotation(random)}};
    const dem_gpu::Vec3 direction = random_direction(random);
    pair.b.position = (touch_distance(probe, pair, direction, 5) - uniform(random, 1e-4, 0.01)) * direction;
    pairs.push_back(pair);
  }
  dem_gpu::SeparationCache cache;
  probe.count_contacts(pairs, cache);  // fills the cache
  double fastest = std::numeric_limits<double>::max();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const CpuClock clock;
    probe.count_contacts(pairs, cache);
    fastest = std::min(fastest, clock.seconds());
  }
  return fastest / kPairs;
}

void add_cost_cases(BenchPlan& plan, const NamedLaw& law) {
  const Shape cube = box_shape({1, 1, 1});
  for (const CostPair& pair : std::vector<CostPair>{{"cost-cube", cube, cube},
                                                    {"cost-L", l_shape(3), l_shape(3)},
                                                    {"cost-cross", cross_shape(5), cross_shape(5)},
                                                    {"cost-rock", rough_rock_shape(), rough_rock_shape()}})
    plan.cases.push_back(
        {pair.name + "-" + law.name, [pair, law]() -> CaseResult {
           return {{{"time a pair of bodies", 1e9 * time_per_pair(pair.a, pair.b, law.law), "ns", {}, ""}}, {}};
         }});
}

}  // namespace workflows
