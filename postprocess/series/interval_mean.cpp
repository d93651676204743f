// SPDX-License-Identifier: Apache-2.0
#include "postprocess/interval_mean.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace postprocess {

std::vector<double> integral_of_averages(const std::vector<double>& times, const std::vector<double>& averages) {
  std::vector<double> integral(times.size(), 0.0);
  for (std::size_t i = 1; i < times.size(); ++i)
    integral[i] = integral[i - 1] + averages[i] * (times[i] - times[i - 1]);
  return integral;
}

double interpolated(const std::vector<double>& times, const std::vector<double>& values, double time) {
  if (times.empty()) return 0;
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return values.front();
  if (after == times.end()) return values.back();
  const std::size_t i = static_cast<std::size_t>(after - times.begin());
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

IntervalMean mean_rate(const std::vector<double>& times, const std::vector<double>& accumulated, double from_time,
                       double to_time, int batches) {
  IntervalMean result{0, 0, batches, from_time, to_time};
  if (times.size() < 2 || to_time <= from_time || batches < 1) return {0, 0, 0, from_time, to_time};
  const double length = (to_time - from_time) / batches;
  std::vector<double> means;
  double before = interpolated(times, accumulated, from_time);
  for (int b = 1; b <= batches; ++b) {
    const double after = interpolated(times, accumulated, b == batches ? to_time : from_time + b * length);
    means.push_back((after - before) / length);
    before = after;
  }
  for (const double mean : means) result.mean += mean / batches;
  if (batches < 2) return result;
  double squares = 0;
  for (const double mean : means) squares += (mean - result.mean) * (mean - result.mean);
  result.half_width = student_t_95(batches - 1) * std::sqrt(squares / (batches - 1) / batches);
  return result;
}

double student_t_95(int degrees_of_freedom) {
  // Abramowitz & Stegun 1964, table 26.10, column 0.975.
  constexpr std::array<double, 30> table{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                                         2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
                                         2.080,  2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042};
  if (degrees_of_freedom < 1) return 0;
  if (degrees_of_freedom <= static_cast<int>(table.size()))
    return table[static_cast<std::size_t>(degrees_of_freedom) - 1];
  // Cornish-Fisher expansion about the normal quantile z (Abramowitz & Stegun 26.7.5), three terms.
  const double z = 1.959964, n = degrees_of_freedom;
  return z + (z * z * z + z) / (4 * n) + (5 * std::pow(z, 5) + 16 * z * z * z + 3 * z) / (96 * n * n);
}

}  // namespace postprocess
