// SPDX-License-Identifier: Apache-2.0
#include "workflows/run_reports.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "workflows/stage_tool.h"
#include "workflows/thread_count.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Vec3;
using Json = nlohmann::ordered_json;

std::string formatted(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string formatted(const char* format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(static_cast<std::size_t>(std::max(length, 0)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

Json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }
Json json_of(const Point& p) { return {p[0], p[1], p[2]}; }

Json json_of(const FillRegion& region) {
  if (const auto* cylinder = std::get_if<CylinderRegion>(&region))
    return {{"cylinder",
             {{"base", json_of(cylinder->base)},
              {"axis", json_of(cylinder->axis)},
              {"radius", cylinder->radius},
              {"length", cylinder->length}}}};
  const auto& box = std::get<BoxRegion>(region);
  return {{"box", {{"min", json_of(box.low)}, {"max", json_of(box.high)}}}};
}

const char* side_of(dem_gpu::SolidSide solid) { return solid == dem_gpu::SolidSide::around ? "inside" : "outside"; }

Json json_of(const dem_gpu::Motion& motion) {
  Json json{{"angular_velocity", json_of(motion.angular_velocity)},
            {"rotation_centre", json_of(motion.rotation_centre)},
            {"velocity", json_of(motion.velocity)},
            {"start", motion.start_time},
            {"ramp", motion.ramp_time}};
  if (motion.frequency > 0) {
    json["amplitude"] = json_of(motion.amplitude);
    json["angular_amplitude"] = json_of(motion.angular_amplitude);
    json["frequency"] = motion.frequency;
    json["phase"] = motion.phase;
  }
  return json;
}

struct WallJson {
  Json operator()(const dem_gpu::Plane& plane) const {
    return {{"type", "plane"}, {"point", json_of(plane.point)}, {"normal", json_of(plane.normal)}};
  }
  Json operator()(const dem_gpu::Disc& disc) const {
    Json json{
        {"type", "disc"}, {"centre", json_of(disc.centre)}, {"normal", json_of(disc.normal)}, {"radius", disc.radius}};
    if (disc.thickness) json["thickness"] = *disc.thickness;
    return json;
  }
  Json operator()(const dem_gpu::Cylinder& cylinder) const {
    return {{"type", "cylinder"},        {"base", json_of(cylinder.base)}, {"axis", json_of(cylinder.axis)},
            {"length", cylinder.length}, {"radius", cylinder.radius},      {"bodies", side_of(cylinder.solid)}};
  }
  Json operator()(const dem_gpu::Cone& cone) const {
    return {{"type", "cone"},
            {"base", json_of(cone.base)},
            {"axis", json_of(cone.axis)},
            {"length", cone.length},
            {"base_radius", cone.base_radius},
            {"top_radius", cone.top_radius},
            {"bodies", side_of(cone.solid)}};
  }
  Json operator()(const dem_gpu::Ball& ball) const {
    return {
        {"type", "sphere"}, {"centre", json_of(ball.centre)}, {"radius", ball.radius}, {"bodies", side_of(ball.solid)}};
  }
  Json operator()(const dem_gpu::MeshObject& object) const {
    Json json{{"type", "mesh"},
              {"vertices", object.mesh.vertices.size()},
              {"triangles", object.mesh.faces.size()},
              {"bodies", object.is_container ? "inside" : "outside"}};
    if (object.thickness) json["thickness"] = *object.thickness;
    if (object.depth > 0) json["depth"] = object.depth;
    return json;
  }
  Json operator()(const dem_gpu::VolumeObject& object) const {
    return {{"type", "polyhedron"}, {"vertices", object.part.vertices}};
  }
};

Json json_of(const dem_gpu::Wall& wall, const Scene& scene) {
  Json json{{"name", wall.name}};
  json.update(std::visit(WallJson{}, wall.geometry));
  json["material"] = scene.materials[static_cast<std::size_t>(wall.material)].name;
  json["class"] = wall.contact_class.empty() ? wall.name : wall.contact_class;
  if (wall.motion != dem_gpu::Motion{}) json["motion"] = json_of(wall.motion);
  if (!wall.group.empty()) json["group"] = wall.group;
  if (wall.removed_at) json["open_at"] = *wall.removed_at;
  return json;
}

Json contact_law(const Scene& scene) {
  Json json;
  if (const dem_gpu::DepthPotential* law = dem_gpu::depth_potential(scene.polyhedral_law))
    json["polyhedra"] = {{"law", "depth_potential"}, {"stiffness", law->stiffness}, {"depth_cap", law->depth_cap}};
  else
    json["polyhedra"] = {{"law", "volume"},
                         {"stiffness", std::get<dem_gpu::OverlapVolume>(scene.polyhedral_law).stiffness}};
  if (const auto* law = std::get_if<dem_gpu::HardeningDepthPotential>(&scene.polyhedral_law))
    json["polyhedra"].update({{"hardening", law->hardening}, {"flat_overlap", law->flat_overlap}});
  if (const auto* law = std::get_if<dem_gpu::LinearSpring>(&scene.sphere_law))
    json["spheres"] = {{"law", "linear"}, {"stiffness", law->stiffness}};
  else
    json["spheres"] = {{"law", "hertz"}};
  json["friction"] = scene.friction.has_value();
  if (scene.friction) json["tangential_stiffness_ratio"] = scene.friction->tangential_stiffness_ratio;
  return json;
}

Json materials(const Scene& scene) {
  Json json = Json::array();
  for (const dem_gpu::Material& material : scene.materials)
    json.push_back({{"name", material.name},
                    {"density", material.density},
                    {"youngs_modulus", material.youngs_modulus},
                    {"poisson_ratio", material.poisson_ratio}});
  return json;
}

Json contacts(const Scene& scene) {
  Json json = Json::array();
  for (std::size_t a = 0; a < scene.materials.size(); ++a)
    for (std::size_t b = a; b < scene.materials.size(); ++b)
      json.push_back({{"materials", {scene.materials[a].name, scene.materials[b].name}},
                      {"restitution", scene.contact[a][b].restitution},
                      {"friction", scene.contact[a][b].friction_coefficient}});
  return json;
}

Json shapes(const AssembledScene& assembled) {
  Json json = Json::array();
  for (const ShapeReport& shape : assembled.shapes)
    json.push_back({{"name", shape.name},
                    {"parts", shape.parts},
                    {"vertices", shape.vertices},
                    {"faces", shape.faces},
                    {"volume", shape.volume},
                    {"symmetric_difference", shape.symmetric_difference},
                    {"volume_error", shape.volume_error}});
  return json;
}

Json fill_summary(const FillReport& report, const FillDescription& fill, const Scene& scene) {
  Json json{{"name", fill.name}};
  if (const auto* shapes = std::get_if<CatalogueShapes>(&fill.shapes)) {
    json["shapes_from"] = shapes->catalogue.string();
    json["select"] = shapes->query;
    json["parts"] = shapes->parts;
    json["vertices"] = shapes->vertex_cap ? Json(*shapes->vertex_cap) : Json(nullptr);
  }
  json["material"] = scene.materials[static_cast<std::size_t>(fill.material)].name;
  json["first_body"] = report.first_body;
  json["bodies"] = report.bodies;
  json["mass"] = report.mass;
  json["region"] = json_of(fill.region);
  constexpr const char* packings[] = {"dense", "hexagonal", "cubic"};
  json["packing"] = packings[static_cast<std::size_t>(fill.layout.packing)];
  json["clearance"] = fill.layout.clearance;
  json["jitter"] = fill.layout.jitter;
  json["seed"] = fill.layout.seed;
  json["velocity"] = json_of(fill.velocity);
  return json;
}

Json chain_summary(const ChainReport& report, const ChainDescription& chain, const Scene& scene) {
  const ChainLayout& layout = chain.layout;
  return {
      {"name", chain.name},
      {"link",
       scene.shapes[static_cast<std::size_t>(scene.bodies[static_cast<std::size_t>(report.first_body)].shape)].name},
      {"material", scene.materials[static_cast<std::size_t>(chain.material)].name},
      {"first_body", report.first_body},
      {"links", report.bodies},
      {"mass", report.mass},
      {"start", json_of(layout.start)},
      {layout.is_closed ? "axis" : "direction", json_of(layout.direction)},
      {"gap", layout.gap},
      {"closed", layout.is_closed},
      {"hold_first", layout.holds_first},
      {"velocity", json_of(chain.velocity)}};
}

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

double imbalance_share(const dem_gpu::EnergyLedger& ledger) {
  return ledger.throughput > 0 ? std::abs(ledger.imbalance()) / ledger.throughput : 0;
}

nlohmann::ordered_json resolved_scene(const AssembledScene& assembled, const SceneDescription& description,
                                      const std::string& scene_folder) {
  const Scene& scene = assembled.scene;
  Json json{{"name", scene.name}, {"tool_version", tool_version()}, {"scene_folder", scene_folder}};
  json["catalogues"] = Json::array();
  for (const CatalogueUsed& used : assembled.catalogues)
    json["catalogues"].push_back({{"path", used.path.string()}, {"sha256", used.sha256}});
  json["gravity"] = json_of(scene.gravity);
  json["run"] = {{"end_time", scene.run.end_time},
                 {"time_step", dem_gpu::time_step(scene)},
                 {"steps_per_contact", scene.run.time_step > 0 ? Json(nullptr) : Json(scene.run.steps_per_contact)},
                 {"preset", dem_gpu::promise_of(scene.run.preset).name},
                 {"largest_start_overlap", scene.run.largest_start_overlap},
                 {"shortest_contact_time", dem_gpu::shortest_contact_time(scene)},
                 {"snapshot_every", scene.run.snapshot_interval},
                 {"checkpoint_every", scene.run.checkpoint_interval},
                 {"series_every", scene.run.series_interval}};
  json["materials"] = materials(scene);
  json["contacts"] = contacts(scene);
  json["contact_law"] = contact_law(scene);
  if (description.stiffness.largest_overlap)
    json["contact_law"]["stiffness_from"] = {{"largest_overlap", *description.stiffness.largest_overlap},
                                             {"at_speed", description.stiffness.at_speed}};
  json["ledger"] = scene.energy_ledger;
  json["shapes"] = shapes(assembled);
  json["fills"] = Json::array();
  for (std::size_t i = 0; i < assembled.fills.size(); ++i)
    json["fills"].push_back(fill_summary(assembled.fills[i], description.fills[i], scene));
  json["chains"] = Json::array();
  for (std::size_t i = 0; i < assembled.chains.size(); ++i)
    json["chains"].push_back(chain_summary(assembled.chains[i], description.chains[i], scene));
  json["walls"] = Json::array();
  for (const dem_gpu::Wall& wall : scene.walls) json["walls"].push_back(json_of(wall, scene));
  json["outflow"] = nullptr;
  if (scene.outflow)
    json["outflow"] = {{"direction", json_of(scene.outflow->direction)}, {"height", scene.outflow->height}};
  json["bodies"] = {{"count", scene.bodies.size()},
                    {"where", "geometry.h5 (shape, material, scale) and snapshots/snapshot_000000.h5 (state)"}};
  return json;
}

std::vector<PromiseKept> promises(const AssembledScene& assembled, const dem_gpu::Simulation& simulation,
                                  const dem_gpu::EnergyLedger& ledger) {
  const dem_gpu::Promise promise = dem_gpu::promise_of(assembled.scene.run.preset);
  const dem_gpu::RunQuality quality = simulation.quality();
  std::vector<PromiseKept> all;
  if (assembled.scene.energy_ledger)
    all.push_back({"energy imbalance, share of the energy put in", imbalance_share(ledger), promise.energy_imbalance,
                   imbalance_share(ledger) <= promise.energy_imbalance});
  all.push_back({"largest overlap, share of the diameter", quality.largest_overlap, promise.largest_overlap,
                 quality.largest_overlap <= promise.largest_overlap});
  if (quality.smallest_steps_per_contact > 0)
    all.push_back({"fewest steps in a contact", quality.smallest_steps_per_contact, promise.steps_per_contact,
                   quality.smallest_steps_per_contact >= promise.steps_per_contact});
  return all;
}

std::string promise_line(const AssembledScene& assembled, const std::vector<PromiseKept>& kept) {
  std::string line = formatted("preset \"%s\"", dem_gpu::promise_of(assembled.scene.run.preset).name);
  const char* before = ": ";
  for (const PromiseKept& one : kept) {
    line += formatted("%s%s %.3g (promised %.3g, %s)", before, one.figure.c_str(), one.value, one.promised,
                      one.is_kept ? "kept" : "broken");
    before = "; ";
  }
  return line;
}

std::optional<std::string> start_warning(const Scene& scene) {
  const dem_gpu::Promise promise = dem_gpu::promise_of(scene.run.preset);
  const double shortest = dem_gpu::shortest_contact_time(scene), steps = shortest / dem_gpu::time_step(scene);
  // Rounding of a step stated to four digits breaks no promise.
  constexpr double kRounding = 1e-3;
  if (steps >= (1 - kRounding) * promise.steps_per_contact) return std::nullopt;
  return formatted(
      "a time step of %.4g us gives the shortest contact (%.4g us) %.3g steps, not the %.3g that preset \"%s\" "
      "promises its accuracy for; use at most %.4g us",
      1e6 * dem_gpu::time_step(scene), 1e6 * shortest, steps, promise.steps_per_contact, promise.name,
      1e6 * shortest / promise.steps_per_contact);
}

std::vector<std::string> run_warnings(const AssembledScene& assembled, const SceneDescription& description,
                                      const dem_gpu::Simulation& simulation, const dem_gpu::EnergyLedger& ledger) {
  std::vector<std::string> warnings;
  const dem_gpu::RunQuality quality = simulation.quality();
  if (const auto warning = start_warning(assembled.scene)) warnings.push_back(*warning);
  const std::vector<PromiseKept> kept = promises(assembled, simulation, ledger);
  if (std::any_of(kept.begin(), kept.end(), [](const PromiseKept& one) { return !one.is_kept; }))
    warnings.push_back(promise_line(assembled, kept) +
                       "; a finer preset or stiffer contacts (a higher at_speed) would mend it");
  if (description.stiffness.largest_overlap && quality.largest_overlap > *description.stiffness.largest_overlap)
    warnings.push_back(
        formatted("the largest overlap was %.4g %% of a body's diameter, at a corner or edge most likely; the %.4g %% "
                  "asked for hold for a flat strike at at_speed; state a higher at_speed for stiffer grains",
                  100 * quality.largest_overlap, 100 * *description.stiffness.largest_overlap));
  return warnings;
}

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
  json["shapes"] = shapes(assembled);
  json["passes"] = simulation.pass_names();
  json["command"] = facts.command;
  json["tool_version"] = tool_version();
  json["warnings"] = run_warnings(assembled, description, simulation, ledger);
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
