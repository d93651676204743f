// SPDX-License-Identifier: Apache-2.0
#include "postprocess/run_folder.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catalog/input_error.h"

namespace postprocess {
namespace {

using nlohmann::json;

/// A JSON object of a file, for messages that name file and key.
class Section {
 public:
  Section(std::filesystem::path file, std::string place, const json& object)
      : file_(std::move(file)), place_(std::move(place)), object_(object) {
    if (!object_.is_object()) refuse("", "an object");
  }

  bool has(const char* key) const { return object_.contains(key) && !object_.at(key).is_null(); }

  std::optional<double> number(const char* key) const {
    if (!has(key)) return std::nullopt;
    if (!object_.at(key).is_number()) refuse(key, "a number");
    return object_.at(key).get<double>();
  }
  std::string text(const char* key) const {
    if (!has(key)) return "";
    if (!object_.at(key).is_string()) refuse(key, "a string");
    return object_.at(key).get<std::string>();
  }
  bool flag(const char* key) const {
    if (!has(key)) return false;
    if (!object_.at(key).is_boolean()) refuse(key, "true or false");
    return object_.at(key).get<bool>();
  }
  Section section(const char* key) const { return {file_, place_ + key + ".", object_.at(key)}; }
  std::vector<Section> sections(const char* key) const {
    std::vector<Section> list;
    for (const json& item : items(key))
      list.emplace_back(file_, place_ + key + "[" + std::to_string(list.size()) + "].", item);
    return list;
  }
  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> list;
    for (const json& item : items(key)) {
      if (!item.is_string()) refuse(key, "a list of strings");
      list.push_back(item.get<std::string>());
    }
    return list;
  }
  /// Rows of at least two numbers: the first, and the one in `column` if the row has it, else the second.
  std::vector<std::pair<double, double>> pairs(const char* key, std::size_t column) const {
    std::vector<std::pair<double, double>> list;
    for (const json& item : items(key)) {
      if (!item.is_array() || item.size() < 2 ||
          !std::all_of(item.begin(), item.end(), [](const json& value) { return value.is_number(); }))
        refuse(key, "rows of two or more numbers");
      list.emplace_back(item[0].get<double>(), item[item.size() > column ? column : 1].get<double>());
    }
    return list;
  }
  std::optional<dem_gpu::Vec3> vector(const char* key) const {
    if (!has(key)) return std::nullopt;
    const json& item = object_.at(key);
    if (!item.is_array() || item.size() != 3 || !item[0].is_number() || !item[1].is_number() || !item[2].is_number())
      refuse(key, "three numbers");
    return dem_gpu::Vec3{item[0].get<double>(), item[1].get<double>(), item[2].get<double>()};
  }

 private:
  json items(const char* key) const {
    if (!has(key)) return json::array();
    if (!object_.at(key).is_array()) refuse(key, "a list");
    return object_.at(key);
  }
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const {
    throw catalog::InputError(file_.string() + ": " + place_ + key + ": expected " + expected);
  }

  std::filesystem::path file_;
  std::string place_;
  json object_;
};

Section read_json(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw catalog::InputError(file.string() + ": cannot be read");
  try {
    return {file, "", json::parse(stream)};
  } catch (const json::parse_error& error) {
    throw catalog::InputError(file.string() + ": byte " + std::to_string(error.byte) +
                              ": not valid JSON; run the simulation again or remove the file");
  } catch (const json::out_of_range&) {
    throw catalog::InputError(file.string() +
                              ": holds a number that is too large; run the simulation again or remove the file");
  }
}

RunSummary::Mill mill_of(const Section& section) {
  return {section.vector("axis"),
          section.number("revolutions"),
          section.number("power_torque_mean"),
          section.number("power_torque_ci"),
          section.number("power_ledger_mean"),
          section.number("from_time"),
          section.number("to_time")};
}

/// Rows are size, passing by mass, passing by number; with two numbers, passing by the stated basis.
RunSummary::SizeDistribution size_distribution_of(const Section& section) {
  RunSummary::SizeDistribution sizes;
  sizes.definition = section.text("definition");
  sizes.basis = section.text("basis");
  const std::size_t column = sizes.basis == "number" ? 2 : 1;
  sizes.requested = section.pairs("requested", column);
  sizes.realised = section.pairs("realised", column);
  sizes.d10 = section.number("d10");
  sizes.d50 = section.number("d50");
  sizes.d80 = section.number("d80");
  sizes.d90 = section.number("d90");
  return sizes;
}

}  // namespace

RunSummary read_run_summary(const std::filesystem::path& file) {
  const Section root = read_json(file);
  RunSummary summary;
  summary.name = root.text("name");
  summary.is_finished = root.flag("finished");
  summary.simulated_time = root.number("simulated_time");
  summary.steps = root.number("steps");
  summary.time_step = root.number("time_step");
  summary.wall_seconds = root.number("wall_seconds");
  summary.backend = root.text("backend");
  summary.precision = root.text("precision");
  if (root.has("energy")) {
    summary.imbalance = root.section("energy").number("imbalance");
    summary.throughput = root.section("energy").number("throughput");
  }
  for (const Section& loss : root.sections("dissipation"))
    summary.dissipation.push_back(
        {loss.text("class"), loss.number("normal").value_or(0), loss.number("shear").value_or(0)});
  if (root.has("quality")) {
    summary.largest_overlap = root.section("quality").number("largest_overlap");
    summary.smallest_steps_per_contact = root.section("quality").number("smallest_steps_per_contact");
  }
  if (root.has("mill")) summary.mill = mill_of(root.section("mill"));
  if (root.has("discharge")) {
    const Section section = root.section("discharge");
    summary.discharge = {section.number("discharged_mass"), section.number("discharged_count"),
                         section.number("time_first"), section.number("rate_mean")};
  }
  if (root.has("size_distribution"))
    summary.size_distribution = size_distribution_of(root.section("size_distribution"));
  for (const Section& shape : root.sections("shapes"))
    summary.shapes.push_back({shape.text("name"), shape.number("parts"), shape.number("vertices"),
                              shape.number("faces"), shape.number("volume"), shape.number("symmetric_difference"),
                              shape.number("volume_error")});
  summary.passes = root.texts("passes");
  summary.warnings = root.texts("warnings");
  summary.command = root.text("command");
  summary.tool_version = root.text("tool_version");
  return summary;
}

std::string RunFolder::name() const {
  if (summary && !summary->name.empty()) return summary->name;
  if (!scene_name.empty()) return scene_name;
  return std::filesystem::weakly_canonical(path).filename().string();
}

RunFolder read_run_folder(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw catalog::InputError(folder.string() + ": no such folder; expected a run folder of talus simulate");
  if (!std::filesystem::exists(folder / "geometry.h5"))
    throw catalog::InputError(folder.string() +
                              ": not a run folder: it has no geometry.h5; name a folder that talus "
                              "simulate wrote");
  RunFolder run;
  run.path = folder;
  run.geometry = dem_gpu::read_geometry(folder / "geometry.h5");
  run.snapshots = dem_gpu::snapshot_files(folder);
  const auto is_there = [&](const char* file) { return std::filesystem::exists(folder / file); };
  if (is_there("run.json")) run.summary = read_run_summary(folder / "run.json");
  if (is_there("time_series.csv")) run.series = read_time_series(folder / "time_series.csv");
  if (is_there("walls.csv")) run.walls = read_grouped_series(folder / "walls.csv", "wall");
  if (is_there("ledger.csv")) run.ledger = read_grouped_series(folder / "ledger.csv", "class");
  if (is_there("resolved_scene.json")) {
    const Section scene = read_json(folder / "resolved_scene.json");
    run.scene_name = scene.text("name");
    if (const auto gravity = scene.vector("gravity"); gravity && norm(*gravity) > 0)
      run.up = -*gravity / norm(*gravity);
  }
  return run;
}

}  // namespace postprocess
