// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "postprocess/discharge.h"
#include "postprocess/mill_power.h"
#include "postprocess/run_folder.h"

namespace postprocess {

/// Largest share of the energy put in by which a run's balance may miss.
inline constexpr double kEnergyGoal = 0.02;

/// A mill's power by two routes, and the curves behind it.
struct MillFigures {
  dem_gpu::Vec3 axis;         // unit
  double angular_speed = 0;   // [rad/s]
  RevolutionWindow window;    // the run's own where run.json has it; revolutions is 0 if they are not whole
  IntervalMean torque_power;  // [W]
  IntervalMean ledger_power;  // [W]
  std::vector<double> times;  // [s]
  std::vector<double> power;  // of all moving walls, averages over the rows [W]
  EnergyAccounts accounts;
};

/// What a run says, worked out from its tables; parts whose tables are missing are empty.
struct RunFigures {
  std::optional<double> imbalance;        // [J]
  std::optional<double> throughput;       // [J]
  std::optional<double> imbalance_share;  // |imbalance| / throughput
  bool energy_balance_closes() const { return imbalance_share && *imbalance_share <= kEnergyGoal; }

  std::optional<double> largest_overlap;  // share of the equivalent diameter
  std::optional<double> smallest_steps_per_contact;
  std::optional<MillFigures> mill;      // if walls turn
  std::optional<Discharge> discharged;  // if bodies left
};

/// `last` is the run's last snapshot, for the direction of a mill's axis where run.json does not have it.
RunFigures run_figures(const RunFolder& run, const std::optional<dem_gpu::Snapshot>& last);

/// Figures as one JSON object a line, for machines.
std::string figures_json(const RunFolder& run, const RunFigures& figures);

/// Indices of the snapshots to draw: first, middle and last. The middle of a run that discharges is where half has
/// left.
std::vector<std::size_t> pictured_snapshots(const RunFolder& run, const std::vector<double>& snapshot_times);

}  // namespace postprocess
