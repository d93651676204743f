// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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
  /// Starts a new file, or, where `keep_until` >= 0, goes on with one: whole rows up to that time [s] stay. A file with
  /// another header is kept as NAME.old.
  SeriesFile(std::filesystem::path file, const std::string& header, double keep_until);
  /// What is missing of the rows up to time `due` [s] that were to be gone on with, in words; empty if nothing.
  std::string gap(double due) const;
  void append(const std::string& row);
  void flush();

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
  std::string fault_;                            // of the file that was to be gone on with
  double last_time_ = -1;                        // of the rows kept [s]; -1 for none
  std::int64_t first_rows_ = 0, last_rows_ = 0;  // rows of the first and the last time
};

/// time_series.csv, walls.csv, ledger.csv and, where walls share a named motion, groups.csv of a run folder.
class RunSeries {
 public:
  RunSeries(const std::filesystem::path& run_folder, const dem_gpu::Scene& scene, double keep_until);

  /// See SeriesFile::gap.
  std::vector<std::string> gaps(double due) const;

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
