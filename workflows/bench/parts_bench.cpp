// SPDX-License-Identifier: Apache-2.0
// How many parts a rock needs: the same bed of rocks poured, tilted and emptied at every level of detail of a shape.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "workflows/bench/bench_registry.h"
#include "workflows/bench/catalogue_levels.h"
#include "workflows/bench/level_cost.h"
#include "workflows/bench/parts/parts_page.h"
#include "workflows/bench/parts/rock_bed.h"
#include "workflows/thread_count.h"

namespace workflows {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::uint64_t kOtherSeeds[] = {2, 3, 4, 5, 6, 7, 8, 9};

/// Largest distance of a vertex from the centre of mass, of a shape of volume 1, over its diameter.
double reach_of(const dem_gpu::Shape& shape) {
  double reach = 0;
  for (const catalog::ConvexPart& part : std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts)
    for (const catalog::Point& vertex : part.vertices)
      reach = std::max(reach, std::hypot(vertex[0], vertex[1], vertex[2]));
  return reach / std::cbrt(6 / std::numbers::pi);
}

double largest_reach(const ShapeLevels& rock) {
  double reach = 0;
  for (const Level& level : rock.shape.levels) reach = std::max(reach, reach_of(rock.unit_shape(level)));
  return reach;
}

/// Hash of the bodies of a bed and where they start: other levels of the catalogue may come and go.
std::string inputs_of(const dem_gpu::Shape& shape, double reach) {
  std::string bytes;
  const auto add = [&](const auto* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof *values);
  };
  for (const catalog::ConvexPart& part : std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts) {
    for (const catalog::Point& vertex : part.vertices) add(vertex.data(), vertex.size());
    for (const catalog::ConvexFace& face : part.faces) {
      add(face.vertices.data(), face.vertices.size());
      add(&face.kind, 1);
    }
  }
  add(&reach, 1);
  return "level " + catalog::sha256(bytes.data(), bytes.size());
}

/// What the bed answers, and what it costs. A run that fails says why in each figure.
struct Response {
  PouredBed poured{{}, {}, kFailedRun, kFailedRun, kFailedRun, kFailedRun, kFailedRun};
  double angle = kFailedRun;
  EmptiedBed emptied{kFailedRun, kFailedRun};
  std::string failure;
};

Response respond(const dem_gpu::Shape& shape, double reach, std::uint64_t seed) {
  Response response;
  try {
    response.poured = pour_bed(shape, reach, seed);
    response.angle = slide_angle(shape, response.poured);
    response.emptied = empty_bed(shape, response.poured);
  } catch (const std::runtime_error& error) {
    response.failure = error.what();
  }
  return response;
}

/// In the order of kBedAnswers.
constexpr double (*kAnswerOf[])(const Response&) = {
    [](const Response& r) { return r.poured.packing_fraction; }, [](const Response& r) { return r.angle; },
    [](const Response& r) { return r.emptied.half_time; }, [](const Response& r) { return r.emptied.left; }};
static_assert(std::size(kAnswerOf) == std::size(kBedAnswers));

void add(CaseResult& result, const std::string& name, double value, const std::string& failure) {
  Figure figure{name, value, "", {}, failure};
  if (std::isnan(value)) {
    figure.value.reset();
    if (failure.empty()) figure.failure = "not reached";
  }
  result.figures.push_back(figure);
}

CaseResult measure_level(const ShapeLevels& rock, const Level& level) {
  const Response response = respond(rock.unit_shape(level), largest_reach(rock), kSeed);
  CaseResult result;
  add(result, kLevelError, level.error.symmetric_difference, "");
  for (std::size_t i = 0; i < std::size(kBedAnswers); ++i)
    add(result, kBedAnswers[i], kAnswerOf[i](response), response.failure);
  add(result, "contacts a rock [-]", response.poured.contacts, response.failure);
  add(result, kStepTime, 1e3 * response.poured.step_time, response.failure);
  add(result, "largest overlap over d [-]", response.poured.largest_overlap, response.failure);
  add(result, "energy imbalance over throughput [-]", response.poured.imbalance, response.failure);
  const std::pair<const char*, double> points[] = {{"packing", response.poured.packing_fraction},
                                                   {"angle", response.angle},
                                                   {"emptying", response.emptied.half_time},
                                                   {"left", response.emptied.left},
                                                   {"cost", 1e3 * response.poured.step_time}};
  for (const auto& [plot, y] : points)
    result.curves.push_back({plot,
                             rock.shape.name + ", " + ladder_text(level.key),
                             {100 * level.error.symmetric_difference},
                             {response.failure.empty() ? y : kFailedRun},
                             {std::to_string(level.key.parts_asked) + " parts"}});
  return result;
}

const Level& cheapest_level(const ShapeLevels& rock) {
  return *std::min_element(rock.shape.levels.begin(), rock.shape.levels.end(),
                           [](const Level& a, const Level& b) { return contact_cost(a) < contact_cost(b); });
}

/// Standard deviation of each answer over other places and attitudes of the rocks, at the cheapest level.
CaseResult measure_spread(const ShapeLevels& rock) {
  const dem_gpu::Shape shape = rock.unit_shape(cheapest_level(rock));
  const double reach = largest_reach(rock);
  std::vector<Response> responses;
  for (const std::uint64_t seed : kOtherSeeds) responses.push_back(respond(shape, reach, seed));
  CaseResult result;
  for (std::size_t i = 0; i < std::size(kBedAnswers); ++i) {
    const auto value = kAnswerOf[i];
    std::string failure;
    double mean = 0, square = 0;
    const auto count = static_cast<double>(responses.size());
    for (const Response& response : responses) {
      if (!response.failure.empty()) failure = response.failure;
      mean += value(response) / count;
    }
    for (const Response& response : responses) square += std::pow(value(response) - mean, 2);
    add(result, mean_of(kBedAnswers[i]), mean, failure);
    add(result, deviation_of(kBedAnswers[i]), std::sqrt(square / (count - 1)), failure);
  }
  return result;
}

}  // namespace

BenchPlan plan_parts_bench(const BenchOptions& options) {
  BenchPlan plan;
  const std::string error = "symmetric difference [%]";
  plan.plots = {{"packing", "Packing fraction of the poured bed", error, "packing fraction [-]", true},
                {"angle", "Tilt at which the bed slides", error, "angle [degrees]", true},
                {"emptying", "Time until half of the rocks are out", error, "time [s]", true},
                {"left", "Share of the rocks that stays on the shelf", error, "share [-]", true},
                {"cost", "Cost of a step of 300 rocks", error, "time a step [ms]"}};
  if (options.catalogue.empty()) {
    plan.lacks = "no catalogue; add --catalog ore.talus";
    plan.cases = {{"levels", nullptr}};
    return plan;
  }
  if (!options.threads.empty()) set_thread_count(options.threads.front());
  std::vector<PartsStudy> studies;
  for (const ShapeLevels& rock : levels_of_catalogue(options.catalogue)) {
    PartsStudy study{rock.shape.name, {}, rock.shape.name + "-spread"};
    const double reach = largest_reach(rock);
    for (const auto& [name, ladder] : rock.ladders())
      for (const Level& level : ladder) {
        const std::string parts = std::to_string(level.key.parts_asked);
        study.rows.push_back({rock.shape.name + "-" + name + "-" + parts, parts + " x " + ladder_text(level.key)});
        plan.cases.push_back({study.rows.back().case_name, [rock, level] { return measure_level(rock, level); },
                              inputs_of(rock.unit_shape(level), reach)});
      }
    plan.cases.push_back({study.spread_case, [rock] { return measure_spread(rock); },
                          inputs_of(rock.unit_shape(cheapest_level(rock)), reach)});
    studies.push_back(std::move(study));
  }
  plan.page = [studies](const std::vector<ReportedFigure>& figures) { return parts_page(figures, studies); };
  return plan;
}

}  // namespace workflows
