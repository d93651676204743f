// SPDX-License-Identifier: Apache-2.0
#include "workflows/run_reports.h"

#include "workflows/idle_settings.h"
#include "workflows/resolved_scene.h"
#include "workflows/run_promises.h"
#include "workflows/stage_tool.h"
#include "workflows/text_format.h"
#include "workflows/thread_count.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using Json = nlohmann::ordered_json;

bool has_size_range(const FillDescription& fill) {
  return fill.size && fill.size->size.front() < fill.size->size.back();
}

/// D10 ... D90 on one basis [m].
Json characteristic_sizes(const RealisedSizes& sample, SizeBasis basis) {
  Json json;
  for (const int percent : {10, 50, 80, 90}) json[formatted("d%d", percent)] = size_at(sample, percent / 100.0, basis);
  return json;
}

/// One fill's distribution: rows [size, share passing by mass, share passing by number].
Json size_distribution(const FillReport& report, const FillDescription& fill) {
  const SizeBasis basis = fill.size->basis;
  Json json{{"fill", fill.name}, {"definition", name_of(fill.definition)}, {"basis", name_of(basis)}};
  for (const char* rows : {"requested", "realised"}) json[rows] = Json::array();
  for (const double size : report_sizes(*fill.size)) {
    json["requested"].push_back(
        {size, passing(*fill.size, size, SizeBasis::mass), passing(*fill.size, size, SizeBasis::number)});
    json["realised"].push_back(
        {size, passing(report.realised, size, SizeBasis::mass), passing(report.realised, size, SizeBasis::number)});
  }
  json.update(characteristic_sizes(report.realised, basis));
  for (const SizeBasis one : {SizeBasis::mass, SizeBasis::number})
    json["by_" + std::string(name_of(one))] = characteristic_sizes(report.realised, one);
  return json;
}

double polyhedral_stiffness(const Scene& scene) {
  return std::visit([](const auto& law) -> double { return law.stiffness; }, scene.polyhedral_law);
}

}  // namespace

nlohmann::ordered_json run_summary(const AssembledScene& assembled, const SceneDescription& description,
                                   const dem_gpu::Simulation& simulation, const dem_gpu::EnergyLedger& ledger,
                                   const RunFacts& facts) {
  Json json{{"name", assembled.scene.name},        {"finished", facts.finished},
            {"simulated_time", simulation.time()}, {"steps", simulation.step()},
            {"time_step", simulation.time_step()}, {"wall_seconds", facts.wall_seconds},
            {"backend", backend_name()},           {"precision", dem_gpu::kPrecision}};
  if (!facts.error.empty()) json["error"] = facts.error;
  json["energy"] = {{"kinetic", ledger.kinetic},
                    {"gravitational", ledger.gravitational},
                    {"elastic_normal", ledger.elastic_normal},
                    {"elastic_tangential", ledger.elastic_tangential},
                    {"wall_work", ledger.wall_work},
                    {"removed", ledger.removed},
                    {"initial", ledger.initial},
                    {"dissipated", ledger.dissipated()},
                    {"imbalance", ledger.imbalance()},
                    {"throughput", ledger.throughput},
                    {"imbalance_share", imbalance_share(ledger)}};
  json["dissipation"] = Json::array();
  for (const auto& loss : ledger.dissipation)
    json["dissipation"].push_back({{"class", loss.contact_class}, {"normal", loss.normal}, {"shear", loss.shear}});
  const dem_gpu::RunQuality quality = simulation.quality();
  json["quality"] = {{"largest_overlap", quality.largest_overlap},
                     {"smallest_steps_per_contact", quality.smallest_steps_per_contact}};
  json["promise"] = {{"preset", dem_gpu::promise_of(assembled.scene.run.preset).name}};
  for (const PromiseKept& one : promises(assembled, simulation, ledger))
    json["promise"]["figures"].push_back(
        {{"figure", one.figure}, {"value", one.value}, {"promised", one.promised}, {"kept", one.is_kept}});
  json["size_distribution"] = nullptr;  // of the first fill with a range of sizes
  json["size_distributions"] = Json::array();
  for (std::size_t i = 0; i < assembled.fills.size(); ++i) {
    if (!has_size_range(description.fills[i])) continue;
    json["size_distributions"].push_back(size_distribution(assembled.fills[i], description.fills[i]));
    json["size_distribution"] = json["size_distributions"].front();
  }
  json["shapes"] = shapes_json(assembled);
  json["passes"] = simulation.pass_names();
  json["command"] = facts.command;
  json["tool_version"] = tool_version();
  json["warnings"] = idle_settings(description, assembled.scene);
  for (const std::string& warning : run_warnings(assembled, description, simulation, ledger))
    json["warnings"].push_back(warning);
  return json;
}

std::string size_table(const AssembledScene& assembled, const SceneDescription& description) {
  std::string table;
  for (std::size_t i = 0; i < assembled.fills.size(); ++i) {
    const FillDescription& fill = description.fills[i];
    const FillReport& report = assembled.fills[i];
    if (!has_size_range(fill)) continue;
    const SizeBasis basis = fill.size->basis;
    table += formatted("sizes of fill \"%s\" (%s, by %s): %d bodies, %.4g kg; passing requested -> realised:\n",
                       fill.name.c_str(), name_of(fill.definition), name_of(basis), report.bodies, report.mass);
    for (const double size : report_sizes(*fill.size))
      table += formatted("  %8.3f mm  %6.2f %% -> %6.2f %%\n", 1e3 * size, 100 * passing(*fill.size, size, basis),
                         100 * passing(report.realised, size, basis));
    for (const SizeBasis one : {SizeBasis::mass, SizeBasis::number})
      table += formatted("  by %-6s  D10 %.3f  D50 %.3f  D80 %.3f  D90 %.3f mm\n", name_of(one),
                         1e3 * size_at(report.realised, 0.1, one), 1e3 * size_at(report.realised, 0.5, one),
                         1e3 * size_at(report.realised, 0.8, one), 1e3 * size_at(report.realised, 0.9, one));
  }
  return table;
}

std::string scene_table(const AssembledScene& assembled) {
  const Scene& scene = assembled.scene;
  std::string table = formatted("scene \"%s\": %zu bodies of %zu shapes, %zu walls\n", scene.name.c_str(),
                                scene.bodies.size(), scene.shapes.size(), scene.walls.size());
  for (std::size_t i = 0; i < assembled.fills.size(); ++i)
    table += formatted("  fill \"%s\": %d bodies, %.4g kg\n", assembled.fills[i].name.c_str(),
                       assembled.fills[i].bodies, assembled.fills[i].mass);
  for (const ChainReport& chain : assembled.chains)
    table += formatted("  chain \"%s\": %d links, %.4g kg\n", chain.name.c_str(), chain.bodies, chain.mass);
  if (polyhedral_stiffness(scene) > 0)
    table += formatted("  stiffness of polyhedra: %.4g N/m3\n", polyhedral_stiffness(scene));
  if (const auto* spring = std::get_if<dem_gpu::LinearSpring>(&scene.sphere_law); spring && spring->stiffness > 0)
    table += formatted("  stiffness of spheres: %.4g N/m\n", spring->stiffness);
  const double time_step = dem_gpu::time_step(scene);
  return table + formatted("  time step: %.4g us (shortest contact %.4g us), %.0f steps to %.4g s\n", 1e6 * time_step,
                           1e6 * dem_gpu::shortest_contact_time(scene), scene.run.end_time / time_step,
                           scene.run.end_time);
}

}  // namespace workflows
