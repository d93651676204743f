// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "postprocess/interval_mean.h"

namespace postprocess {

/// Loads on the rotating walls of a mill over time; row i holds averages from times[i - 1] to times[i].
struct MillLoads {
  std::vector<double> times;   // [s]
  std::vector<double> torque;  // that the charge exerts on the walls, about the axis along the axis [N m]
  double angular_speed = 0;    // signed, about the axis [rad/s]
};

/// Energy accounts of the run over time; rows are values at times[i].
struct EnergyAccounts {
  std::vector<double> times;       // [s]
  std::vector<double> stored;      // kinetic + gravitational + elastic [J]
  std::vector<double> dissipated;  // [J]
};

/// Time window of whole revolutions that ends with the series.
struct RevolutionWindow {
  double from_time = 0;  // [s]
  double to_time = 0;    // [s]
  int revolutions = 0;   // 0: not one whole revolution lies in the series; the window is its second half then
};

/// The last `revolutions` whole revolutions; 0 asks for all that fit after the first one (one if only one fits).
RevolutionWindow whole_revolutions(const std::vector<double>& times, double angular_speed, int revolutions = 0);

/// Angular speed [rad/s] for which power = -angular_speed * torque holds best (least squares); 0 if no torque acts.
double angular_speed_from(const std::vector<double>& torque, const std::vector<double>& power);

/// Mean power [W] that the mill's drive spends on the charge: -torque * angular speed over the window.
IntervalMean power_from_torque(const MillLoads& loads, const RevolutionWindow& window);

/// The same from the energy ledger: the rate at which stored plus dissipated energy grows over the window [W].
IntervalMean power_from_ledger(const EnergyAccounts& accounts, const RevolutionWindow& window);

}  // namespace postprocess
