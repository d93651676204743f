// SPDX-License-Identifier: Apache-2.0
// Levels of detail of a catalogue's shapes: error against what a contact of such bodies costs the engine.
#include <algorithm>
#include <cmath>
#include <map>

#include "catalog/input_error.h"
#include "catalog/shape_catalog.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/laws/laws_cases.h"
#include "workflows/level_choice.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

const dem_gpu::PolyhedralLaw kLaw = dem_gpu::DepthPotential{1};

/// The level at a volume of 1, so that the depths of the pairs are shares of the size.
dem_gpu::Shape unit_shape(const std::string& name, catalog::LevelOfDetail level) {
  const double size = std::cbrt(level.mass_properties.volume);
  for (catalog::ConvexPart& part : level.parts) {
    for (catalog::Point& p : part.vertices)
      for (double& x : p) x /= size;
    for (catalog::ConvexFace& face : part.faces) face.plane.offset /= size;
  }
  return dem_gpu::polyhedral_shape(name, level.parts);
}

/// What the levels of one ladder have in common: "64", "64-f34-enclosing".
std::string ladder_name(const catalog::LevelKey& key) {
  std::string name = std::to_string(key.vertex_cap);
  if (key.face_cap > 0) name += "-f" + std::to_string(key.face_cap);
  return key.mode == catalog::FitMode::volume_true ? name : name + "-" + mode_name(key.mode);
}

/// The same in words.
std::string ladder_text(const catalog::LevelKey& key) {
  std::string text = std::to_string(key.vertex_cap) + " vertices";
  if (key.face_cap > 0) text += ", " + std::to_string(key.face_cap) + " faces";
  return key.mode == catalog::FitMode::volume_true ? text : text + ", " + mode_name(key.mode);
}

/// All levels of one shape, one mode, one cap of vertices and one of faces.
CaseResult measure_ladder(const fs::path& path, const catalog::ShapeSummary& shape, const std::vector<Level>& ladder) {
  const catalog::ShapeCatalog catalogue(path, catalog::ShapeCatalog::Access::read_only);
  const dem_gpu::Shape cube = box_shape({1, 1, 1});
  const double cube_time = time_per_pair(cube, cube, kLaw);
  CaseResult result;
  PlotCurve curve{"front", shape.name + ", " + ladder_text(ladder.front().key), {}, {}, {}};
  for (const Level& level : ladder) {
    const dem_gpu::Shape body = unit_shape(shape.name, catalogue.level(shape.id, level.key));
    const double cost = time_per_pair(body, body, kLaw) / cube_time;
    const std::string parts = std::to_string(level.key.parts_asked) + " parts: ";
    result.figures.push_back({parts + "symmetric difference", level.error.symmetric_difference, "-", {}, ""});
    result.figures.push_back({parts + "time of a contact over that of cubes", cost, "-", {}, ""});
    result.figures.push_back({parts + "contact_cost over that", contact_cost(level) / cost, "-", {}, ""});
    curve.x.push_back(cost);
    curve.y.push_back(level.error.symmetric_difference);
    curve.point_names.push_back(std::to_string(level.key.parts_asked));
  }
  result.curves.push_back(std::move(curve));
  return result;
}

}  // namespace

BenchPlan plan_levels_bench(const BenchOptions& options) {
  BenchPlan plan;
  plan.plots = {{"front", "Error of a level against the cost of a contact", "time of a contact [contacts of cubes]",
                 "symmetric difference [-]"}};
  if (options.catalogue.empty()) {
    plan.cases = {{"ladder", []() -> CaseResult {
                     throw catalog::UsageError("bench levels: no catalogue; add --catalog ore.talus");
                   }}};
    return plan;
  }
  const fs::path path = options.catalogue;
  const catalog::ShapeCatalog catalogue(path, catalog::ShapeCatalog::Access::read_only);
  for (const catalog::ShapeId id : catalogue.select("")) {
    const catalog::ShapeSummary shape = catalogue.summary(id);
    std::map<std::string, std::vector<Level>> ladders;
    for (const Level& level : shape.levels) ladders[ladder_name(level.key)].push_back(level);
    for (const auto& [name, ladder] : ladders)
      plan.cases.push_back(
          {shape.name + "-" + name, [path, shape, ladder = ladder] { return measure_ladder(path, shape, ladder); }});
  }
  if (plan.cases.empty())
    throw catalog::InputError(path.string() + ": has no levels of detail; make them with talus decompose");
  return plan;
}

}  // namespace workflows
