// SPDX-License-Identifier: Apache-2.0
#include "workflows/scene_reader.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "workflows/atomic_file.h"
#include "workflows/scene_sections.h"

namespace workflows {
namespace {

using dem_gpu::Scene;

// Bounds beyond which no material, machine or toy scaling lies, and squares and ratios would run over.
constexpr Bounds kAcceleration{-1e6, 1e6, false, "from -1e6 to 1e6 m/s2"};
constexpr Bounds kImpactSpeed{1e-9, 1e6, false, "more than 0 (1e-9 to 1e6 m/s)"};
constexpr Bounds kStiffness{1e-9, 1e24, false, "more than 0 (1e-9 to 1e24 in SI)"};
constexpr Bounds kModulus{1e-6, 1e18, false, "more than 0 (1e-6 to 1e18 Pa)"};
constexpr Bounds kDensity{1e-6, 1e18, false, "more than 0 (1e-6 to 1e18 kg/m3)"};
constexpr Bounds kFriction{0, 1e6, false, "0 or more, at most 1e6"};
constexpr Bounds kRollingFriction{0, 1, false, "0 or more, at most 1"};
constexpr Bounds kAdhesion{0, 1000, false, "0 or more, at most 1000 J/m2"};
constexpr Bounds kHardening{1e-6, 1e6, false, "more than 0 (1e-6 to 1e6)"};
constexpr Bounds kSpringRatio{1e-6, 1e6, false, "more than 0 (1e-6 to 1e6)"};
// Finer steps drown what they gain in rounding, and no run ends.
constexpr Bounds kStepsPerContact{0, 100'000, true, "more than 0, at most 100000"};

// Snapshots of a run that states no interval: enough for a smooth animation.
constexpr int kUsualSnapshots = 50;

void read_run(TomlTable table, dem_gpu::RunControl& run) {
  run.end_time = table.quantity("end_time", Dimension::time, kPositive);
  const bool automatic = !table.has("time_step") || (table.is_text("time_step") && table.text("time_step") == "auto");
  run.time_step = automatic ? 0 : table.quantity("time_step", Dimension::time, kPositive);
  if (table.has("preset") && table.has("steps_per_contact"))
    table.refuse("steps_per_contact", "preset and steps_per_contact both state the time step; keep one");
  if (!automatic && table.has("steps_per_contact"))
    table.refuse("time_step", "time_step is given, so steps_per_contact has no meaning; keep one");
  if (table.has("preset"))
    run.preset = static_cast<dem_gpu::Preset>(table.choice("preset", {"draft", "standard", "reference"}));
  run.steps_per_contact = table.quantity("steps_per_contact", Dimension::ratio, kStepsPerContact,
                                         dem_gpu::promise_of(run.preset).steps_per_contact);
  run.largest_start_overlap =
      table.quantity("largest_start_overlap", Dimension::ratio, kPositive, run.largest_start_overlap);
  run.snapshot_interval = table.quantity("snapshot_every", Dimension::time, kPositive, run.end_time / kUsualSnapshots);
  run.checkpoint_interval = table.quantity("checkpoint_every", Dimension::time, kNotNegative, 0);
  run.series_interval = table.quantity("series_every", Dimension::time, kPositive, run.snapshot_interval);
  table.finish();
}

void read_materials(TomlTable& file, SceneDescription& description) {
  Scene& scene = description.scene;
  for (TomlTable& table : file.named_tables("material")) {
    dem_gpu::Material material;
    material.name = table.name();
    description.places["material '" + material.name + "'"] = table.place();
    material.density = table.quantity("density", Dimension::density, kDensity);
    material.youngs_modulus = table.quantity("youngs_modulus", Dimension::pressure, kModulus, material.youngs_modulus);
    const Bounds poisson{-1, 0.5, true, "more than -1, at most 0.5"};
    material.poisson_ratio = table.quantity("poisson_ratio", Dimension::ratio, poisson, material.poisson_ratio);
    table.finish();
    scene.materials.push_back(material);
  }
  if (scene.materials.empty()) file.refuse("no material; add a section such as [material.rock] with its density");
}

dem_gpu::ContactProperties read_contact(TomlTable& table, const dem_gpu::ContactProperties* defaults) {
  const Bounds restitution{0, 1, false, "from 0 to 1"};
  dem_gpu::ContactProperties contact;
  contact.restitution = defaults ? table.quantity("restitution", Dimension::ratio, restitution, defaults->restitution)
                                 : table.quantity("restitution", Dimension::ratio, restitution);
  contact.friction_coefficient =
      defaults ? table.quantity("friction", Dimension::ratio, kFriction, defaults->friction_coefficient)
               : table.quantity("friction", Dimension::ratio, kFriction);
  const dem_gpu::ContactProperties otherwise = defaults ? *defaults : dem_gpu::ContactProperties{};
  contact.rolling_friction =
      table.quantity("rolling_friction", Dimension::ratio, kRollingFriction, otherwise.rolling_friction);
  contact.adhesion = table.quantity("adhesion", Dimension::surface_energy, kAdhesion, otherwise.adhesion);
  table.finish();
  return contact;
}

/// Every material pair takes [contact.default] unless [contact."a-b"] says otherwise.
void read_contacts(TomlTable& file, SceneDescription& description) {
  Scene& scene = description.scene;
  const std::size_t count = scene.materials.size();
  std::vector<TomlTable> tables = file.named_tables("contact");
  const dem_gpu::ContactProperties* defaults = nullptr;
  dem_gpu::ContactProperties default_contact;
  for (TomlTable& table : tables)
    if (table.name() == "default") {
      default_contact = read_contact(table, nullptr);
      description.places["contact of "] = table.place();
      defaults = &default_contact;
    }
  if (!defaults) file.refuse("section [contact.default] with restitution and friction is missing");

  std::set<std::pair<std::size_t, std::size_t>> seen;
  scene.contact.assign(count, std::vector<dem_gpu::ContactProperties>(count, default_contact));
  for (TomlTable& table : tables) {
    if (table.name() == "default") continue;
    std::vector<std::string> pairs{"default"};
    bool is_known = false;
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b) {
        pairs.push_back(scene.materials[a].name + "-" + scene.materials[b].name);
        if (pairs.back() != table.name() || is_known) continue;
        is_known = true;
        if (!seen.insert(std::minmax(a, b)).second)
          table.refuse("this pair of materials is stated already, in the other order; keep one");
        scene.contact[a][b] = scene.contact[b][a] = read_contact(table, defaults);
        for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)})
          description
              .places["contact of '" + scene.materials[one].name + "' with '" + scene.materials[other].name + "'"] =
              table.place();
      }
    if (!is_known) table.refuse("not a pair of materials; " + catalog::word_hint(table.name(), pairs));
  }
}

void read_contact_law(TomlTable table, SceneDescription& description) {
  Scene& scene = description.scene;
  StiffnessChoice& stiffness = description.stiffness;
  description.places["contact law"] = table.place();
  if (!table.has("polyhedra") || table.choice("polyhedra", {"depth_potential", "volume"}) == 0) {
    dem_gpu::DepthPotential law;
    law.depth_cap = table.quantity("depth_cap", Dimension::ratio, kShare, law.depth_cap);
    scene.polyhedral_law = law;
    if (const auto hardening = table.optional_quantity("hardening", Dimension::ratio, kHardening))
      scene.polyhedral_law = dem_gpu::HardeningDepthPotential{law, *hardening};
  } else {
    scene.polyhedral_law = dem_gpu::OverlapVolume{};
  }
  const bool is_hertz = table.has("spheres") && table.choice("spheres", {"linear", "hertz"}) == 1;
  scene.sphere_law = is_hertz ? dem_gpu::SphereLaw(dem_gpu::Hertz{}) : dem_gpu::SphereLaw(dem_gpu::LinearSpring{});

  stiffness.polyhedra = table.optional_quantity("stiffness", Dimension::stiffness_volume, kStiffness);
  if (!is_hertz)
    stiffness.spheres = table.optional_quantity("sphere_stiffness", Dimension::stiffness_length, kStiffness);
  const Bounds overlap{0, 0.2, true, "more than 0, at most 20 %"};
  stiffness.largest_overlap = table.optional_quantity("largest_overlap", Dimension::ratio, overlap);
  if (stiffness.largest_overlap) {
    if (stiffness.polyhedra && (stiffness.spheres || is_hertz))
      table.refuse("largest_overlap", "every stiffness is given, so largest_overlap has no meaning; keep one");
    stiffness.at_speed = table.quantity("at_speed", Dimension::speed, kImpactSpeed);
    if (table.has("overlap_at"))
      stiffness.overlap_at = dem_gpu::OverlapAt{table.choice("overlap_at", {"face", "corner"})};
  } else if (!stiffness.polyhedra && !stiffness.spheres && !is_hertz) {
    table.refuse("state how stiff contacts are: largest_overlap = \"3 %\" with at_speed = \"2 m/s\", or stiffness");
  }

  dem_gpu::Friction friction;
  friction.tangential_stiffness_ratio =
      table.quantity("tangential_stiffness_ratio", Dimension::ratio, kSpringRatio, friction.tangential_stiffness_ratio);
  scene.friction = table.flag("friction", true) ? std::optional(friction) : std::nullopt;
  table.finish();
}

void read_outflow(TomlTable& file, SceneDescription& description) {
  std::optional<TomlTable> table = file.optional_table("outflow");
  if (!table) return;
  description.places["outflow: "] = table->place();
  dem_gpu::Outflow outflow;
  if (table->has("direction")) outflow.direction = to_vec3(table->direction("direction"));
  outflow.height = table->quantity("height", Dimension::length);
  table->finish();
  description.scene.outflow = outflow;
}

dem_gpu::PeriodicSpan read_span(TomlTable& table, std::string_view axis) {
  const toml::array& ends = table.array(axis);
  if (ends.size() != 2) table.refuse(axis, std::string(axis) + " must be a pair: where the box begins and ends");
  const std::string place(axis);
  const dem_gpu::PeriodicSpan span{table.element(ends[0], place + "[0]", Dimension::length, kAny),
                                   table.element(ends[1], place + "[1]", Dimension::length, kAny)};
  if (!(span.low < span.high)) table.refuse(axis, place + " must ascend: the box begins below where it ends");
  return span;
}

void read_periodic(TomlTable& file, SceneDescription& description) {
  std::optional<TomlTable> table = file.optional_table("periodic");
  if (!table) return;
  description.places["periodic box: "] = table->place();
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  dem_gpu::PeriodicBox box;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    if (table->has(axes[axis])) box.span[axis] = read_span(*table, axes[axis]);
  table->finish();
  if (box == dem_gpu::PeriodicBox{}) table->refuse("state along which axes, such as x = [\"0 mm\", \"120 mm\"]");
  description.scene.periodic = box;
}

}  // namespace

int read_material_name(TomlTable& table, std::string_view key, const std::vector<dem_gpu::Material>& materials) {
  std::vector<std::string> names;
  for (const dem_gpu::Material& material : materials) names.push_back(material.name);
  return table.choice(key, names);
}

SceneDescription read_scene_text(std::string text, const std::filesystem::path& file,
                                 const std::filesystem::path& base_folder) {
  toml::table root;
  try {
    root = toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw catalog::InputError(file.string() + ":" + std::to_string(begin.line) + ":" + std::to_string(begin.column) +
                              ": not TOML: " + std::string(error.description()));
  }

  SceneDescription description;
  description.file = file;
  description.text = std::move(text);
  Scene& scene = description.scene;
  TomlTable table(root, file.string(), "");
  table.expect_only({"name", "gravity", "run", "material", "contact", "contact_law", "ledger", "motion", "wall",
                     "lifters", "outflow", "periodic", "fill", "chain"});
  scene.name = table.plain_name("name", file.stem().string());
  if (scene.name == "." || scene.name == "..")
    table.refuse(
        "name", "name is \"" + scene.name + "\"; a name must not be \".\" or \"..\": the run's folder is named for it");
  if (table.has("gravity")) scene.gravity = to_vec3(table.vector("gravity", Dimension::acceleration, kAcceleration));
  const TomlTable run = table.table("run");
  description.places["run: "] = run.place();
  read_run(run, scene.run);
  read_materials(table, description);
  read_contacts(table, description);
  read_contact_law(table.table("contact_law"), description);
  if (std::optional<TomlTable> ledger = table.optional_table("ledger")) {
    scene.energy_ledger = ledger->flag("enabled", true);
    ledger->finish();
  }
  read_walls(table, read_motions(table, description), base_folder, description);
  read_outflow(table, description);
  read_periodic(table, description);
  description.fills = read_fills(table, scene, base_folder);
  description.chains = read_chains(table, scene, base_folder);
  if (description.fills.empty() && description.chains.empty())
    table.refuse("nothing to simulate: add a [[fill]] or [[chain]] section");
  return description;
}

SceneDescription read_scene(const std::filesystem::path& file, const std::filesystem::path& base_folder) {
  if (!std::filesystem::exists(file))
    throw catalog::InputError(file.string() + ": no such file; expected a scene file (TOML)");
  std::optional<std::string> text = read_whole(file);
  if (!text) throw catalog::InputError(file.string() + ": cannot be read; expected a scene file (TOML)");
  if (text->find_first_not_of(" \t\r\n") == std::string::npos)
    throw catalog::InputError(file.string() + ": is empty; start from workflows/scenes/hopper.toml");
  return read_scene_text(std::move(*text), file, base_folder.empty() ? file.parent_path() : base_folder);
}

}  // namespace workflows
