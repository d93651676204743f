// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "shape_pipeline/digitization.h"
#include "workflows/digitize_batch.h"
#include "workflows/stage_tool.h"

namespace workflows {

/// What is done to clouds before they are surfaced, as typed.
struct CloudSettings {
  bool is_registered = false;  // the inputs are parts of one particle
  bool removes_plane = false;  // turntable or floor
  bool is_separated = false;   // several grains in a cloud
  int grain_points = 500;      // least, of a separated grain

  bool are_given() const { return is_registered || removes_plane || is_separated; }
};

/// Clouds that need work before they are surfaced, into a catalogue: parts of one particle registered and merged; floor
/// planes removed; grains on one plate separated, as NAME_01, ... from that of most points down. What is there from the
/// same bytes with the same options is skipped; what cannot be used is kept as rejected with its reason. Throws like
/// DigitizeBatch.
class CloudBatch {
 public:
  CloudBatch(const DigitizeBatchOptions& options, const CloudSettings& settings);
  void run();

  const DigitizeBatchOptions& options() const { return options_; }
  const std::vector<DigitizedScan>& outcomes() const { return outcomes_; }

  /// The points that the grains of a source were made from: registered, cleared of floors. `file`: its first one.
  /// Throws InputError as run() rejects.
  shape_pipeline::PointCloud source_cloud(const std::filesystem::path& file) const;

 private:
  /// Files that become one cloud.
  struct Job {
    std::string name;
    std::vector<std::filesystem::path> files;
  };
  struct Grain {
    shape_pipeline::PointCloud cloud;
    std::vector<catalog::Check> checks;
    std::vector<std::string> notes;  // for who runs the batch
  };
  void digitize(const Job& job);
  bool is_done(const Job& job, const catalog::Provenance& provenance);
  Grain merged(const Job& job) const;
  void store(const Job& job, const std::string& name, const catalog::Provenance& provenance, const Grain& grain);
  void reject(const Job& job, const std::string& name, const std::string& hash, const std::string& reason);

  DigitizeBatchOptions options_;
  CloudSettings settings_;
  shape_pipeline::DigitizationOptions digitization_;
  std::vector<Job> jobs_;
  catalog::ShapeCatalog catalog_;
  BatchProgress progress_;
  std::vector<DigitizedScan> outcomes_;
};

}  // namespace workflows
