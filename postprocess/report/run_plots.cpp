// SPDX-License-Identifier: Apache-2.0
#include "postprocess/run_plots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "postprocess/svg_plot.h"

namespace postprocess {
namespace {

constexpr int kRateWindows = 40;
constexpr const char* kTime = "time [s]";

std::vector<double> sum_of(const TimeSeries& series, std::initializer_list<const char*> names) {
  std::vector<double> total(series.row_count(), 0.0);
  for (const char* name : names)
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += series.at(name)[i];
  return total;
}

std::vector<NamedPlot> discharge_plots(const TimeSeries& series) {
  const std::vector<double>& time = series.at("time");
  const RateCurve rate = rate_curve(time, series.at("removed_mass"), kRateWindows);
  const LinePlot mass{"Discharged mass", kTime, "mass [kg]", {{"", time, series.at("removed_mass")}}, {}};
  const LinePlot count{"Discharged bodies", kTime, "bodies [-]", {{"", time, series.at("removed_bodies")}}, {}};
  const LinePlot speed{"Discharge rate", kTime, "rate [kg/s]", {{"", rate.times, rate.rates}}, {}};
  return {{"discharge_mass", svg(mass)}, {"discharge_count", svg(count)}, {"discharge_rate", svg(speed)}};
}

/// Power from torque against power from the ledger, both over the same windows so that they can be compared.
NamedPlot power_plot(const MillFigures& mill) {
  LinePlot plot{"Mill power", kTime, "power [W]", {}, {}};
  const RateCurve torque = rate_curve(mill.times, integral_of_averages(mill.times, mill.power), kRateWindows);
  plot.curves.push_back({"from torque", torque.times, torque.rates});
  if (!mill.accounts.times.empty()) {
    std::vector<double> energy(mill.accounts.times.size());
    for (std::size_t i = 0; i < energy.size(); ++i) energy[i] = mill.accounts.stored[i] + mill.accounts.dissipated[i];
    const RateCurve ledger = rate_curve(mill.accounts.times, energy, kRateWindows);
    plot.curves.push_back({"from the energy ledger", ledger.times, ledger.rates, true});
  }
  const auto [from, to] = std::pair{mill.torque_power.from_time, mill.torque_power.to_time};
  const int turns = mill.window.revolutions;
  plot.curves.push_back({turns == 0   ? "mean from " + short_number(from, 3) + " s on"
                         : turns == 1 ? std::string("mean of the last whole revolution")
                                      : "mean of the last " + std::to_string(turns) + " whole revolutions",
                         {from, to},
                         {mill.torque_power.mean, mill.torque_power.mean}});
  return {"power", svg(plot)};
}

std::vector<NamedPlot> energy_plots(const TimeSeries& series) {
  const std::vector<double>& time = series.at("time");
  LinePlot energy{"Energies", kTime, "energy [J]", {}, {}};
  energy.curves = {{"kinetic", time, series.at("kinetic")},
                   {"gravitational", time, series.at("gravitational")},
                   {"elastic", time, sum_of(series, {"elastic_normal", "elastic_tangential"})},
                   {"dissipated", time, sum_of(series, {"dissipated_normal", "dissipated_shear"})},
                   {"work of walls", time, series.at("wall_work")},
                   {"left with bodies", time, series.at("removed_energy")}};
  // A balance over almost nothing put in says nothing: the curve starts once a hundredth of the throughput is reached.
  std::vector<double> share(series.row_count(), std::numeric_limits<double>::quiet_NaN());
  const std::vector<double>&imbalance = series.at("imbalance"), &throughput = series.at("throughput");
  for (std::size_t i = 0; i < share.size(); ++i)
    if (throughput[i] > 0.01 * throughput.back()) share[i] = 100 * imbalance[i] / throughput[i];
  const double low = time.empty() ? 0 : time.front(), high = time.empty() ? 1 : time.back();
  LinePlot balance{"Energy balance", kTime, "imbalance / throughput [%]", {}, {}};
  balance.curves = {{"imbalance", time, share},
                    {"goal", {low, high}, {100 * kEnergyGoal, 100 * kEnergyGoal}, true},
                    {"", {low, high}, {-100 * kEnergyGoal, -100 * kEnergyGoal}, true}};
  return {{"energy", svg(energy)}, {"energy_balance", svg(balance)}};
}

/// Losses by class at the end: from run.json, else from the ledger's last rows.
std::vector<RunSummary::ClassLoss> final_losses(const RunFolder& run) {
  if (run.summary && !run.summary->dissipation.empty()) return run.summary->dissipation;
  std::vector<RunSummary::ClassLoss> losses;
  for (const auto& [name, series] : run.ledger)
    if (series.row_count() > 0)
      losses.push_back({name, series.at("dissipation_normal").back(), series.at("dissipation_shear").back()});
  return losses;
}

NamedPlot dissipation_plot(const std::vector<RunSummary::ClassLoss>& losses) {
  BarPlot plot{"Dissipated energy by contact class", "energy [J]", "damping (normal)", "friction (shear)", {}};
  for (const RunSummary::ClassLoss& loss : losses) plot.bars.push_back({loss.contact_class, loss.normal, loss.shear});
  std::stable_sort(plot.bars.begin(), plot.bars.end(),
                   [](const auto& a, const auto& b) { return a.first + a.second > b.first + b.second; });
  return {"dissipation", svg(plot)};
}

/// Loads of the walls, those of one contact class added up: a mill has many lifters.
std::vector<NamedPlot> wall_plots(const RunFolder& run) {
  std::map<std::string, std::string> class_of;
  for (const dem_gpu::WallGeometry& wall : run.geometry.walls)
    class_of[wall.name] = wall.contact_class.empty() ? wall.name : wall.contact_class;
  std::map<std::string, Curve> force, power;
  for (const auto& [name, loads] : run.walls) {
    const std::string label = class_of.contains(name) ? class_of[name] : name;
    const std::vector<double>& time = loads.at("time");
    for (auto* curves : {&force, &power}) {
      Curve& curve = (*curves)[label];
      if (curve.x.empty()) curve = {label, time, std::vector<double>(time.size(), 0.0)};
    }
    const auto &x = loads.at("force_x"), &y = loads.at("force_y"), &z = loads.at("force_z");
    for (std::size_t i = 0; i < std::min(time.size(), force[label].y.size()); ++i) {
      force[label].y[i] += std::hypot(x[i], y[i], z[i]);
      power[label].y[i] += loads.at("power")[i];
    }
  }
  LinePlot forces{"Force on the walls, magnitudes added by class", kTime, "force [N]", {}, {}};
  LinePlot powers{"Power of the walls by class", kTime, "power [W]", {}, {}};
  for (auto& [label, curve] : force) forces.curves.push_back(curve);
  for (auto& [label, curve] : power)
    if (std::any_of(curve.y.begin(), curve.y.end(), [](double p) { return p != 0; })) powers.curves.push_back(curve);
  std::vector<NamedPlot> plots{{"wall_force", svg(forces)}};
  if (!powers.curves.empty()) plots.push_back({"wall_power", svg(powers)});
  return plots;
}

NamedPlot size_plot(const RunSummary::SizeDistribution& sizes) {
  LinePlot plot{
      "Size distribution", "size, " + sizes.definition + " [mm]", "passing by " + sizes.basis + " [%]", {}, {}};
  const auto add = [&](const char* label, const std::vector<std::pair<double, double>>& points, bool is_dashed) {
    Curve curve{label, {}, {}, is_dashed};
    for (const auto& [size, passing] : points) {
      curve.x.push_back(1000 * size);
      curve.y.push_back(100 * passing);
    }
    if (!curve.x.empty()) plot.curves.push_back(curve);
  };
  add("realised", sizes.realised, false);
  add("asked for", sizes.requested, true);
  plot.y_range = {0, 100};
  return {"size_distribution", svg(plot)};
}

}  // namespace

std::vector<NamedPlot> run_plots(const RunFolder& run, const RunFigures& figures) {
  std::vector<NamedPlot> plots;
  const auto add = [&](std::vector<NamedPlot> more) { std::move(more.begin(), more.end(), std::back_inserter(plots)); };
  const bool has_series = run.series && run.series->row_count() > 1;
  if (figures.mill) plots.push_back(power_plot(*figures.mill));
  if (has_series && figures.discharged) add(discharge_plots(*run.series));
  if (has_series) add(energy_plots(*run.series));
  if (const auto losses = final_losses(run); !losses.empty()) plots.push_back(dissipation_plot(losses));
  if (!run.walls.empty()) add(wall_plots(run));
  if (run.summary && run.summary->size_distribution) plots.push_back(size_plot(*run.summary->size_distribution));
  return plots;
}

}  // namespace postprocess
