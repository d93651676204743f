// SPDX-License-Identifier: Apache-2.0
#include "postprocess/mill_power.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace postprocess {
namespace {

// Batches per window: enough for Student's t to be of use, and at one revolution each is still longer than the time a
// lifter takes to pass.
constexpr int kBatches = 6;

// Rounding of the last row's time must not cost a revolution [share of a revolution].
constexpr double kRevolutionSlack = 1e-6;

int batches_within(const std::vector<double>& times, const RevolutionWindow& window) {
  const auto rows =
      std::count_if(times.begin(), times.end(), [&](double t) { return t > window.from_time && t <= window.to_time; });
  return std::clamp(static_cast<int>(rows) / 2, 1, kBatches);
}

}  // namespace

RevolutionWindow whole_revolutions(const std::vector<double>& times, double angular_speed, int revolutions) {
  if (times.size() < 2) return {};
  const double first = times.front(), last = times.back();
  const RevolutionWindow second_half{(first + last) / 2, last, 0};
  if (angular_speed == 0) return second_half;
  const double period = 2 * std::numbers::pi / std::abs(angular_speed);
  const int whole = static_cast<int>(std::floor((last - first) / period + kRevolutionSlack));
  if (whole < 1) return second_half;
  const int used = revolutions > 0 ? std::min(revolutions, whole) : std::max(1, whole - 1);
  return {std::max(first, last - used * period), last, used};
}

double angular_speed_from(const std::vector<double>& torque, const std::vector<double>& power) {
  double cross = 0, squares = 0;
  for (std::size_t i = 0; i < torque.size(); ++i) {
    cross += torque[i] * power[i];
    squares += torque[i] * torque[i];
  }
  return squares > 0 ? -cross / squares : 0;
}

IntervalMean power_from_torque(const MillLoads& loads, const RevolutionWindow& window) {
  std::vector<double> power(loads.torque.size());
  std::transform(loads.torque.begin(), loads.torque.end(), power.begin(),
                 [&](double torque) { return -torque * loads.angular_speed; });
  return mean_rate(loads.times, integral_of_averages(loads.times, power), window.from_time, window.to_time,
                   batches_within(loads.times, window));
}

IntervalMean power_from_ledger(const EnergyAccounts& accounts, const RevolutionWindow& window) {
  std::vector<double> energy(accounts.times.size());
  for (std::size_t i = 0; i < energy.size(); ++i) energy[i] = accounts.stored[i] + accounts.dissipated[i];
  return mean_rate(accounts.times, energy, window.from_time, window.to_time, batches_within(accounts.times, window));
}

}  // namespace postprocess
