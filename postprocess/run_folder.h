// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dem_gpu/snapshot.h"
#include "postprocess/time_series.h"

namespace postprocess {

/// run.json. What an older or unfinished run does not have is empty.
struct RunSummary {
  std::string name;
  bool is_finished = false;
  std::optional<double> simulated_time;  // [s]
  std::optional<double> steps;
  std::optional<double> time_step;     // [s]
  std::optional<double> wall_seconds;  // [s]
  std::string backend;
  std::string precision;

  std::optional<double> imbalance;   // [J]
  std::optional<double> throughput;  // [J]

  struct ClassLoss {
    std::string contact_class;
    double normal = 0;  // [J]
    double shear = 0;   // [J]
  };
  std::vector<ClassLoss> dissipation;

  std::optional<double> largest_overlap;  // share of the equivalent diameter
  std::optional<double> smallest_steps_per_contact;

  struct Mill {
    std::optional<dem_gpu::Vec3> axis;  // unit
    std::optional<double> revolutions, power_torque_mean, power_torque_ci, power_ledger_mean, from_time, to_time;
  };
  std::optional<Mill> mill;

  struct Discharge {
    std::optional<double> mass, count, time_first, rate_mean;  // [kg], [-], [s], [kg/s]
  };
  std::optional<Discharge> discharge;

  struct SizeDistribution {
    std::string definition, basis;
    std::vector<std::pair<double, double>> requested;  // size [m], passing [-]
    std::vector<std::pair<double, double>> realised;
    std::optional<double> d10, d50, d80, d90;  // [m]
  };
  std::optional<SizeDistribution> size_distribution;

  struct ShapeError {
    std::string name;
    std::optional<double> parts, vertices, faces, volume, symmetric_difference, volume_error;
  };
  std::vector<ShapeError> shapes;

  std::vector<std::string> passes;
  std::vector<std::string> warnings;
  std::string command;
  std::string tool_version;
};

/// Everything in a run folder but the snapshots themselves.
struct RunFolder {
  std::filesystem::path path;
  dem_gpu::RunGeometry geometry;
  std::vector<std::filesystem::path> snapshots;  // ascending
  std::optional<RunSummary> summary;             // absent while the run goes on
  std::optional<TimeSeries> series;
  std::map<std::string, TimeSeries> walls;   // loads, by wall
  std::map<std::string, TimeSeries> ledger;  // dissipation, by contact class
  dem_gpu::Vec3 up{0, 0, 1};                 // opposite to gravity
  std::string scene_name;

  std::string name() const;  // of the run, else of the scene, else of the folder
};

/// Reads a run folder as `talus simulate` leaves it. geometry.h5 must be there; a CSV table or run.json may be missing,
/// but one that is there must be whole. Throws catalog::InputError naming file and place.
RunFolder read_run_folder(const std::filesystem::path& folder);

RunSummary read_run_summary(const std::filesystem::path& file);

}  // namespace postprocess
