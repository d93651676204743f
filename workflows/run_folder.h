// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dem_gpu/snapshot.h"
#include "workflows/scene_assembly.h"

namespace workflows {

/// A run's folder; its files are listed in dem_gpu/snapshot.h. It also keeps the scene file as it was (scene.toml), so
/// that a run can be resumed with nothing else.
class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path scene_file() const { return path_ / "scene.toml"; }
  std::filesystem::path snapshot_file(std::int64_t number) const;

  /// Refuses a folder that holds a run already, or anything else.
  void refuse_if_used() const;
  /// Refuses a folder that holds no run.
  void require_run() const;

  bool is_finished() const;
  bool has_checkpoint() const;
  /// run.json or resolved_scene.json; an empty object if it cannot be read.
  nlohmann::ordered_json read_json(const char* name) const;

  /// Keeps other processes off the folder as long as this lives; refuses if one has it already.
  void lock();
  /// Makes and locks the folder, with scene.toml, resolved_scene.json and geometry.h5.
  void start(const SceneDescription& description, const nlohmann::ordered_json& resolved,
             const dem_gpu::RunGeometry& geometry);
  /// What a resumed run needs and is missing or damaged, made again where it can be: the folder of snapshots and
  /// geometry.h5. Says what was found missing, snapshots up to `last_snapshot` among it, one line each.
  std::vector<std::string> mend(const dem_gpu::RunGeometry& geometry, std::int64_t last_snapshot) const;
  void write_json(const char* name, const nlohmann::ordered_json& json) const;
  /// Removes the snapshots that a run left which is now gone on with from an earlier moment.
  void remove_snapshots_after(std::int64_t number) const;
  void write_snapshot(std::int64_t number, const dem_gpu::Snapshot& snapshot) const;
  /// Adds a line, with the time of day, to run.log.
  void log(const std::string& line) const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;  // descriptor of the file "lock"
};

}  // namespace workflows
