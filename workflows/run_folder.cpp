// SPDX-License-Identifier: Apache-2.0
#include "workflows/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <vector>

#include "catalog/input_error.h"
#include "workflows/atomic_file.h"

namespace workflows {

namespace fs = std::filesystem;

RunFolder::~RunFolder() {
  if (lock_ >= 0) ::close(lock_);
}

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

bool RunFolder::is_finished() const {
  const nlohmann::ordered_json summary = read_json("run.json");
  return summary.contains("finished") && summary["finished"] == true;
}

bool RunFolder::has_checkpoint() const {
  return fs::exists(path_ / "checkpoint.h5") || fs::exists(path_ / "checkpoint_previous.h5");
}

nlohmann::ordered_json RunFolder::read_json(const char* name) const {
  const std::string text = read_whole(path_ / name).value_or("");
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text, nullptr, false);
  return json.is_object() ? json : nlohmann::ordered_json::object();
}

void RunFolder::lock() {
  lock_ = ::open((path_ / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0)
    throw catalog::InputError(path_.string() + ": cannot be written (" + std::strerror(errno) +
                              "); make it writable or choose another --out");
  // File systems that know no locks are let pass.
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw catalog::InputError(path_.string() +
                              ": is being run by another process; wait for it or choose another --out");
}

void RunFolder::start(const SceneDescription& description, const nlohmann::ordered_json& resolved,
                      const dem_gpu::RunGeometry& geometry) {
  try {
    fs::create_directories(path_ / "snapshots");
  } catch (const fs::filesystem_error& error) {
    throw catalog::InputError(path_.string() + ": cannot be made (" + error.code().message() +
                              "); choose a folder that can be written with --out");
  }
  lock();
  if (fs::exists(scene_file())) refuse_if_used();  // another process was quicker
  write_json("resolved_scene.json", resolved);
  dem_gpu::write_geometry(path_ / "geometry.h5", geometry);
  // Last: from here on the folder counts as a run.
  write_whole(scene_file(), description.text);
}

std::vector<std::string> RunFolder::mend(const dem_gpu::RunGeometry& geometry, std::int64_t last_snapshot) const {
  std::vector<std::string> notes;
  const fs::path file = path_ / "geometry.h5";
  try {
    dem_gpu::read_geometry(file);
  } catch (const catalog::InputError& error) {
    notes.push_back(std::string(error.what()) + "; it was made again from the scene");
    dem_gpu::write_geometry(file, geometry);
  }
  fs::create_directories(path_ / "snapshots");
  std::int64_t missing = 0;
  for (std::int64_t number = 0; number <= last_snapshot; ++number) missing += !fs::exists(snapshot_file(number));
  if (missing > 0)
    notes.push_back((path_ / "snapshots").string() + ": " + std::to_string(missing) + " of the " +
                    std::to_string(last_snapshot + 1) + " snapshots so far are missing; the run goes on without them");
  return notes;
}

void RunFolder::write_json(const char* name, const nlohmann::ordered_json& json) const {
  write_whole(path_ / name, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void RunFolder::remove_snapshots_after(std::int64_t number) const {
  std::vector<fs::path> later;
  for (const auto& entry : fs::directory_iterator(path_ / "snapshots")) {
    long long found = 0;
    if (std::sscanf(entry.path().filename().c_str(), "snapshot_%lld.h5", &found) == 1 && found > number &&
        entry.path() == snapshot_file(found))
      later.push_back(entry.path());
  }
  for (const fs::path& file : later) fs::remove(file);
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
