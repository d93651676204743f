// SPDX-License-Identifier: Apache-2.0
#include "workflows/series_files.h"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "workflows/atomic_file.h"

namespace workflows {
namespace {

constexpr const char* kTimeSeriesHeader =
    "time[s],step[-],active_bodies[-],active_mass[kg],removed_bodies[-],removed_mass[kg],contacts[-],kinetic[J],"
    "gravitational[J],elastic_normal[J],elastic_tangential[J],dissipated_normal[J],dissipated_shear[J],wall_work[J],"
    "removed_energy[J],imbalance[J],throughput[J],largest_overlap[-],steps_per_second[1/s]";
constexpr const char* kWallsHeader =
    "time[s],wall,force_x[N],force_y[N],force_z[N],torque_x[N m],torque_y[N m],torque_z[N m],power[W],work[J]";
constexpr const char* kGroupsHeader =
    "time[s],group,force_x[N],force_y[N],force_z[N],torque_x[N m],torque_y[N m],torque_z[N m],power[W],work[J]";
constexpr const char* kLedgerHeader = "time[s],class,dissipation_normal[J],dissipation_shear[J]";

std::string cell(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

std::string row(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& one : cells) line += (line.empty() ? "" : ",") + one;
  return line;
}

/// A name as a CSV cell (RFC 4180).
std::string name_cell(const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos) return name;
  std::string cell = "\"";
  for (const char letter : name) cell += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return cell + "\"";
}

std::string load_row(const std::string& time, const std::string& name, const dem_gpu::WallLoad& load) {
  return row({time, name_cell(name), cell(load.force.x), cell(load.force.y), cell(load.force.z), cell(load.torque.x),
              cell(load.torque.y), cell(load.torque.z), cell(load.power), cell(load.work)});
}

/// Times are printed to 12 digits: the largest that may be meant by one.
double rounded_up(double time) { return time + 1e-11 * (1 + time); }

/// Calls visit(time, row with its end) for whole rows up to a time.
template <class Visitor>
void visit_rows(const std::string& text, double until, const Visitor& visit) {
  std::size_t start = text.find('\n') + 1;
  for (std::size_t end = text.find('\n', start); end != std::string::npos; end = text.find('\n', start)) {
    const double time = std::strtod(text.c_str() + start, nullptr);
    if (time > rounded_up(until)) break;
    visit(time, text.substr(start, end + 1 - start));
    start = end + 1;
  }
}

}  // namespace

SeriesFile::SeriesFile(std::filesystem::path file, const std::string& header, double keep_until)
    : file_(std::move(file)) {
  std::string kept = header + "\n";
  if (keep_until >= 0) {
    const std::optional<std::string> earlier = read_whole(file_);
    if (!earlier) {
      fault_ = "was missing";
    } else if (earlier->starts_with(kept)) {
      double first_time = -1;
      visit_rows(*earlier, keep_until, [&](double time, const std::string& row) {
        kept += row;
        if (first_time < 0) first_time = time;
        first_rows_ += time == first_time;
        last_rows_ = time == last_time_ ? last_rows_ + 1 : 1;
        last_time_ = time;
      });
    } else {
      fault_ = "has another header, and is kept as " + file_.filename().string() + ".old";
      std::filesystem::rename(file_, file_.string() + ".old");
    }
  }
  write_whole(file_, kept);
  stream_.open(file_, std::ios::app);
}

std::string SeriesFile::gap(double due) const {
  const std::string lost = "; it goes on without its rows up to " + cell(due) + " s";
  if (!fault_.empty()) return file_.string() + ": " + fault_ + lost;
  if (rounded_up(last_time_) < due)
    return file_.string() + ": " + (last_time_ < 0 ? "has no rows" : "ends at " + cell(last_time_) + " s") + lost;
  if (last_rows_ < first_rows_) return file_.string() + ": was cut; it goes on without some rows of its last time";
  return "";
}

void SeriesFile::append(const std::string& row) { stream_ << row << '\n'; }

void SeriesFile::flush() {
  if (!stream_.flush()) throw std::runtime_error(file_.string() + ": cannot be written; is the disk full?");
}

RunSeries::RunSeries(const std::filesystem::path& run_folder, const dem_gpu::Scene& scene, double keep_until)
    : has_ledger_(scene.energy_ledger),
      time_series_(run_folder / "time_series.csv", kTimeSeriesHeader, keep_until),
      walls_(run_folder / "walls.csv", kWallsHeader, keep_until),
      ledger_(run_folder / "ledger.csv", kLedgerHeader, keep_until) {
  for (const dem_gpu::Wall& wall : scene.walls) {
    wall_names_.push_back(wall.name);
    wall_groups_.push_back(wall.group);
    if (!wall.group.empty() && !groups_) groups_.emplace(run_folder / "groups.csv", kGroupsHeader, keep_until);
  }
}

std::vector<std::string> RunSeries::gaps(double due) const {
  std::vector<std::string> all;
  const auto add = [&](const SeriesFile& file) {
    if (std::string gap = file.gap(due); !gap.empty()) all.push_back(std::move(gap));
  };
  add(time_series_);
  if (!wall_names_.empty()) add(walls_);
  if (has_ledger_) add(ledger_);
  if (groups_) add(*groups_);
  return all;
}

void RunSeries::append_groups(const std::string& time, const std::vector<dem_gpu::WallLoad>& loads) {
  std::map<std::string, dem_gpu::WallLoad> sums;
  for (std::size_t wall = 0; wall < loads.size(); ++wall) {
    if (wall_groups_[wall].empty()) continue;
    dem_gpu::WallLoad& sum = sums[wall_groups_[wall]];
    sum.force += loads[wall].force;
    sum.torque += loads[wall].torque;
    sum.power += loads[wall].power;
    sum.work += loads[wall].work;
  }
  for (const auto& [group, load] : sums) groups_->append(load_row(time, group, load));
  groups_->flush();
}

void RunSeries::append(dem_gpu::Simulation& simulation, const dem_gpu::EnergyLedger& ledger, double steps_per_second) {
  const std::string time = cell(simulation.time());
  const dem_gpu::BulkState bulk = simulation.bulk();
  double normal = 0, shear = 0;
  for (const auto& loss : ledger.dissipation) {
    normal += loss.normal;
    shear += loss.shear;
    if (has_ledger_) ledger_.append(row({time, name_cell(loss.contact_class), cell(loss.normal), cell(loss.shear)}));
  }
  time_series_.append(row(
      {time, std::to_string(simulation.step()), std::to_string(bulk.active_bodies), cell(bulk.active_mass),
       std::to_string(bulk.removed_bodies), cell(bulk.removed_mass), std::to_string(bulk.contacts),
       cell(ledger.kinetic), cell(ledger.gravitational), cell(ledger.elastic_normal), cell(ledger.elastic_tangential),
       cell(normal), cell(shear), cell(ledger.wall_work), cell(ledger.removed), cell(ledger.imbalance()),
       cell(ledger.throughput), cell(simulation.quality().largest_overlap), cell(steps_per_second)}));
  const std::vector<dem_gpu::WallLoad> loads = simulation.take_wall_loads();
  for (std::size_t wall = 0; wall < loads.size(); ++wall) walls_.append(load_row(time, wall_names_[wall], loads[wall]));
  if (groups_) append_groups(time, loads);
  time_series_.flush();
  walls_.flush();
  ledger_.flush();
}

}  // namespace workflows
