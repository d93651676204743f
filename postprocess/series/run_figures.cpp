// SPDX-License-Identifier: Apache-2.0
#include "postprocess/run_figures.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace postprocess {
namespace {

using dem_gpu::Vec3;

// Rounding of times written with few digits [share of the time].
constexpr double kTimeSlack = 1e-6;
// A window this near to whole revolutions counts as whole: it ends at a table row, not at the very angle [revolutions].
constexpr double kTurnSlack = 0.02;

/// Axis of the walls' rotation; nullopt if none turns.
std::optional<Vec3> rotation_axis(const RunFolder& run, const std::optional<dem_gpu::Snapshot>& last) {
  if (run.summary && run.summary->mill && run.summary->mill->axis)
    return dem_gpu::unit_or(*run.summary->mill->axis, {0, 0, 1});
  if (!last) return std::nullopt;
  for (const dem_gpu::Quaternion& q : last->wall_rotation) {
    const Vec3 axis{q.x, q.y, q.z};
    if (norm(axis) > 1e-9) return axis / norm(axis);
  }
  return std::nullopt;
}

EnergyAccounts energy_accounts(const TimeSeries& series) {
  EnergyAccounts accounts;
  accounts.times = series.at("time");
  const auto sum = [&](std::initializer_list<const char*> names) {
    std::vector<double> total(series.row_count(), 0.0);
    for (const char* name : names)
      for (std::size_t i = 0; i < total.size(); ++i) total[i] += series.at(name)[i];
    return total;
  };
  accounts.stored = sum({"kinetic", "gravitational", "elastic_normal", "elastic_tangential", "removed_energy"});
  accounts.dissipated = sum({"dissipated_normal", "dissipated_shear"});
  return accounts;
}

/// The window that the run itself averaged over, so that report and run tell one figure; else the last whole
/// revolutions.
RevolutionWindow averaging_window(const RunFolder& run, const MillFigures& mill) {
  const RevolutionWindow own = whole_revolutions(mill.times, mill.angular_speed);
  if (!run.summary || !run.summary->mill) return own;
  const auto &from = run.summary->mill->from_time, &to = run.summary->mill->to_time;
  if (!from || !to || *from < mill.times.front() || *to <= *from || *to > mill.times.back() * (1 + kTimeSlack))
    return own;
  const double turns = (*to - *from) * std::abs(mill.angular_speed) / (2 * std::numbers::pi);
  const bool are_whole = turns > 0.5 && std::abs(turns - std::round(turns)) < kTurnSlack;
  return {*from, *to, are_whole ? static_cast<int>(std::round(turns)) : 0};
}

/// Sum over the walls that turn, row by row of the first: all walls are written at the same times.
std::optional<MillFigures> mill_figures(const RunFolder& run, const std::optional<dem_gpu::Snapshot>& last) {
  const std::optional<Vec3> axis = rotation_axis(run, last);
  if (!axis || run.walls.empty()) return std::nullopt;
  MillFigures mill;
  mill.axis = *axis;
  std::vector<double> torque;
  for (const auto& [name, loads] : run.walls) {
    const std::vector<double>& power = loads.at("power");
    const bool is_moving = std::any_of(power.begin(), power.end(), [](double p) { return p != 0; });
    if (!is_moving) continue;
    if (mill.times.empty()) {
      mill.times = loads.at("time");
      mill.power.assign(mill.times.size(), 0.0);
      torque.assign(mill.times.size(), 0.0);
    }
    const auto &x = loads.at("torque_x"), &y = loads.at("torque_y"), &z = loads.at("torque_z");
    for (std::size_t i = 0; i < std::min(power.size(), torque.size()); ++i) {
      torque[i] += dot(mill.axis, Vec3{x[i], y[i], z[i]});
      mill.power[i] += power[i];
    }
  }
  if (mill.times.size() < 2) return std::nullopt;
  // The speed at the end of the run: start-up ramps are over in the second half.
  const auto half = static_cast<std::ptrdiff_t>(torque.size() / 2);
  mill.angular_speed =
      angular_speed_from({torque.begin() + half, torque.end()}, {mill.power.begin() + half, mill.power.end()});
  mill.window = averaging_window(run, mill);
  mill.torque_power = power_from_torque({mill.times, torque, mill.angular_speed}, mill.window);
  if (run.series) {
    mill.accounts = energy_accounts(*run.series);
    mill.ledger_power = power_from_ledger(mill.accounts, mill.window);
  }
  return mill;
}

std::optional<double> last_of(const std::optional<TimeSeries>& series, const char* name) {
  if (!series || series->row_count() == 0 || !series->has(name)) return std::nullopt;
  return series->at(name).back();
}

}  // namespace

RunFigures run_figures(const RunFolder& run, const std::optional<dem_gpu::Snapshot>& last) {
  RunFigures figures;
  figures.imbalance = last_of(run.series, "imbalance");
  figures.throughput = last_of(run.series, "throughput");
  figures.largest_overlap = last_of(run.series, "largest_overlap");
  if (run.summary) {
    if (run.summary->imbalance) figures.imbalance = run.summary->imbalance;
    if (run.summary->throughput) figures.throughput = run.summary->throughput;
    if (run.summary->largest_overlap) figures.largest_overlap = run.summary->largest_overlap;
    figures.smallest_steps_per_contact = run.summary->smallest_steps_per_contact;
  }
  if (figures.imbalance && figures.throughput && *figures.throughput > 0)
    figures.imbalance_share = std::abs(*figures.imbalance) / *figures.throughput;
  figures.mill = mill_figures(run, last);
  if (run.series && run.series->row_count() > 0 && run.series->at("removed_bodies").back() > 0)
    figures.discharged =
        discharge(run.series->at("time"), run.series->at("removed_mass"), run.series->at("removed_bodies"));
  return figures;
}

std::string figures_json(const RunFolder& run, const RunFigures& figures) {
  nlohmann::ordered_json object;
  object["run"] = run.name();
  object["finished"] = run.summary && run.summary->is_finished;
  const auto put = [&](const char* key, const std::optional<double>& value) {
    if (value) object[key] = *value;
  };
  put("imbalance_J", figures.imbalance);
  put("throughput_J", figures.throughput);
  put("imbalance_share", figures.imbalance_share);
  if (figures.imbalance_share) object["energy_balance_closes"] = figures.energy_balance_closes();
  put("largest_overlap", figures.largest_overlap);
  put("smallest_steps_per_contact", figures.smallest_steps_per_contact);
  if (figures.mill) {
    const MillFigures& mill = *figures.mill;
    object["mill"] = {
        {"angular_speed_rad_per_s", mill.angular_speed}, {"revolutions_averaged", mill.window.revolutions},
        {"from_time_s", mill.window.from_time},          {"to_time_s", mill.window.to_time},
        {"power_torque_W", mill.torque_power.mean},      {"power_torque_half_width_W", mill.torque_power.half_width},
        {"power_ledger_W", mill.ledger_power.mean},      {"power_ledger_half_width_W", mill.ledger_power.half_width}};
  }
  if (figures.discharged) {
    const Discharge& out = *figures.discharged;
    object["discharge"] = {{"mass_kg", out.mass},
                           {"bodies", out.count},
                           {"first_time_s", out.first_time},
                           {"rate_kg_per_s", out.rate.mean},
                           {"rate_half_width_kg_per_s", out.rate.half_width}};
  }
  return object.dump();
}

std::vector<std::size_t> pictured_snapshots(const RunFolder& run, const std::vector<double>& snapshot_times) {
  const std::size_t count = snapshot_times.size();
  if (count == 0) return {};
  std::size_t middle = count / 2;
  if (run.series && run.series->row_count() > 0 && run.series->at("removed_mass").back() > 0) {
    const std::vector<double>& mass = run.series->at("removed_mass");
    const auto half = std::lower_bound(mass.begin(), mass.end(), mass.back() / 2);
    const double time = run.series->at("time")[static_cast<std::size_t>(half - mass.begin())];
    const auto after = std::lower_bound(snapshot_times.begin(), snapshot_times.end(), time);
    middle = std::min(static_cast<std::size_t>(after - snapshot_times.begin()), count - 1);
  }
  std::vector<std::size_t> chosen{0, middle, count - 1};
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

}  // namespace postprocess
