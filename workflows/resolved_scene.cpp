// SPDX-License-Identifier: Apache-2.0
#include "workflows/resolved_scene.h"

#include "workflows/stage_tool.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Vec3;
using Json = nlohmann::ordered_json;

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

Json json_of(const dem_gpu::PeriodicBox& box) {
  const auto span = [](const std::optional<dem_gpu::PeriodicSpan>& one) {
    return one ? Json{one->low, one->high} : Json(nullptr);
  };
  return {{"x", span(box.span[0])}, {"y", span(box.span[1])}, {"z", span(box.span[2])}};
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
                      {"friction", scene.contact[a][b].friction_coefficient},
                      {"rolling_friction", scene.contact[a][b].rolling_friction},
                      {"adhesion", scene.contact[a][b].adhesion}});
  return json;
}

Json fill_summary(const FillReport& report, const FillDescription& fill, const Scene& scene) {
  Json json{{"name", fill.name}};
  if (const auto* shapes = std::get_if<CatalogueShapes>(&fill.shapes)) {
    json["shapes_from"] = shapes->catalogue.string();
    json["select"] = shapes->query;
    if (shapes->parts) json["parts"] = *shapes->parts;
    if (shapes->tolerance) json["tolerance"] = *shapes->tolerance;
    json["mode"] = mode_name(shapes->levels.mode);
    json["vertices"] = shapes->levels.vertex_cap ? Json(*shapes->levels.vertex_cap) : Json(nullptr);
    json["faces"] = shapes->levels.face_cap ? Json(*shapes->levels.face_cap) : Json(nullptr);
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

}  // namespace

nlohmann::ordered_json shapes_json(const AssembledScene& assembled) {
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
  json["shapes"] = shapes_json(assembled);
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
  json["periodic"] = nullptr;
  if (scene.periodic) json["periodic"] = json_of(*scene.periodic);
  json["bodies"] = {{"count", scene.bodies.size()},
                    {"where", "geometry.h5 (shape, material, scale) and snapshots/snapshot_000000.h5 (state)"}};
  return json;
}

}  // namespace workflows
