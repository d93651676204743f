// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "postprocess/interval_mean.h"

namespace postprocess {

/// What a hopper gave out.
struct Discharge {
  double mass = 0;        // discharged at the end [kg]
  double count = 0;       // [-]
  double first_time = 0;  // when the first body left [s]; meaningless if count is 0
  IntervalMean rate;      // over the steady part [kg/s]
};

/// Steady part: from 10 % to 80 % of the mass that left, which leaves out the opening and the dribble at the end
/// (Beverloo, Leniger & van de Velde, Chem. Eng. Sci. 15 (1961) 260, weigh such a middle part as well).
inline constexpr double kSteadyFrom = 0.1;
inline constexpr double kSteadyTo = 0.8;

/// `removed_mass` [kg] and `removed_count` since time 0 at `times` [s]; equal sizes, never falling.
Discharge discharge(const std::vector<double>& times, const std::vector<double>& removed_mass,
                    const std::vector<double>& removed_count);

/// Rate [1/s times the unit of `accumulated`] over equal windows: for a curve. Times are the windows' middles.
struct RateCurve {
  std::vector<double> times;
  std::vector<double> rates;
};
RateCurve rate_curve(const std::vector<double>& times, const std::vector<double>& accumulated, int windows);

}  // namespace postprocess
