// SPDX-License-Identifier: Apache-2.0
#include "workflows/run_folder.h"

#include <cstdio>
#include <ctime>
#include <fstream>

#include "catalog/input_error.h"
#include "workflows/atomic_file.h"

namespace workflows {

namespace fs = std::filesystem;

fs::path RunFolder::snapshot_file(std::int64_t number) const {
  char name[40];
  std::snprintf(name, sizeof name, "snapshot_%06lld.h5", static_cast<long long>(number));
  return path_ / "snapshots" / name;
}

void RunFolder::refuse_if_used() const {
  if (!fs::exists(path_)) return;
  if (!fs::is_directory(path_))
    throw catalog::InputError(path_.string() + ": is a file, not a folder for a run; choose another with --out");
  if (fs::exists(scene_file()))
    throw catalog::InputError(path_.string() + ": holds a run already" + (is_finished() ? ", finished" : "") +
                              "; go on with it by --resume " + path_.string() +
                              ", or choose another folder with --out");
  if (!fs::is_empty(path_))
    throw catalog::InputError(path_.string() + ": is not empty and holds no run; choose another folder with --out");
}

void RunFolder::require_run() const {
  if (!fs::is_directory(path_) || !fs::exists(scene_file()))
    throw catalog::InputError(path_.string() +
                              ": holds no run to resume (no scene.toml in it); expected the folder "
                              "that an earlier talus simulate made");
}

bool RunFolder::is_finished() const { return read_json("run.json").value("finished", false); }

bool RunFolder::has_checkpoint() const {
  return fs::exists(path_ / "checkpoint.h5") || fs::exists(path_ / "checkpoint_previous.h5");
}

nlohmann::ordered_json RunFolder::read_json(const char* name) const {
  const std::string text = read_whole(path_ / name).value_or("");
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text, nullptr, false);
  return json.is_object() ? json : nlohmann::ordered_json::object();
}

void RunFolder::start(const SceneDescription& description, const nlohmann::ordered_json& resolved,
                      const dem_gpu::RunGeometry& geometry) const {
  fs::create_directories(path_ / "snapshots");
  write_json("resolved_scene.json", resolved);
  dem_gpu::write_geometry(path_ / "geometry.h5", geometry);
  // Last: from here on the folder counts as a run.
  write_whole(scene_file(), description.text);
}

void RunFolder::write_json(const char* name, const nlohmann::ordered_json& json) const {
  write_whole(path_ / name, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void RunFolder::write_snapshot(std::int64_t number, const dem_gpu::Snapshot& snapshot) const {
  dem_gpu::write_snapshot(snapshot_file(number), snapshot);
}

void RunFolder::log(const std::string& line) const {
  const std::time_t now = std::time(nullptr);
  std::tm calendar{};
  gmtime_r(&now, &calendar);
  char stamp[32];
  std::strftime(stamp, sizeof stamp, "%Y-%m-%dT%H:%M:%SZ ", &calendar);
  std::ofstream(path_ / "run.log", std::ios::app) << stamp << line << '\n';
}

}  // namespace workflows
