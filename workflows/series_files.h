// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "dem_gpu/simulation.h"

namespace workflows {

/// A CSV file that grows by rows, the first column being time.
class SeriesFile {
 public:
  /// Starts a new file, or, where `keep_until` >= 0, goes on with one: whole rows up to that time [s] stay.
  SeriesFile(std::filesystem::path file, const std::string& header, double keep_until);
  void append(const std::string& row);
  void flush();

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
};

/// time_series.csv, walls.csv, ledger.csv and, where walls share a named motion, groups.csv of a run folder.
class RunSeries {
 public:
  RunSeries(const std::filesystem::path& run_folder, const dem_gpu::Scene& scene, double keep_until);

  /// One row of each. `steps_per_second` since the last one.
  void append(dem_gpu::Simulation& simulation, const dem_gpu::EnergyLedger& ledger, double steps_per_second);

 private:
  void append_groups(const std::string& time, const std::vector<dem_gpu::WallLoad>& loads);

  std::vector<std::string> wall_names_, wall_groups_;
  bool has_ledger_;
  SeriesFile time_series_, walls_, ledger_;
  std::optional<SeriesFile> groups_;  // where walls share a motion
};

}  // namespace workflows
