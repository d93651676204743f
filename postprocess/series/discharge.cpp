// SPDX-License-Identifier: Apache-2.0
#include "postprocess/discharge.h"

#include <algorithm>

namespace postprocess {
namespace {

constexpr int kBatches = 6;

/// First time at which the accumulated quantity reaches `level`, interpolated.
double time_of_level(const std::vector<double>& times, const std::vector<double>& accumulated, double level) {
  const auto after = std::lower_bound(accumulated.begin(), accumulated.end(), level);
  if (after == accumulated.begin()) return times.front();
  if (after == accumulated.end()) return times.back();
  const std::size_t i = static_cast<std::size_t>(after - accumulated.begin());
  const double share = (level - accumulated[i - 1]) / (accumulated[i] - accumulated[i - 1]);
  return times[i - 1] + share * (times[i] - times[i - 1]);
}

}  // namespace

Discharge discharge(const std::vector<double>& times, const std::vector<double>& removed_mass,
                    const std::vector<double>& removed_count) {
  Discharge result;
  if (times.empty() || removed_count.back() <= 0) return result;
  result.mass = removed_mass.back();
  result.count = removed_count.back();
  const auto first = std::find_if(removed_count.begin(), removed_count.end(), [](double n) { return n > 0; });
  result.first_time = times[static_cast<std::size_t>(first - removed_count.begin())];
  const double from = time_of_level(times, removed_mass, kSteadyFrom * result.mass);
  const double to = time_of_level(times, removed_mass, kSteadyTo * result.mass);
  const auto rows = std::count_if(times.begin(), times.end(), [&](double t) { return t > from && t <= to; });
  result.rate = mean_rate(times, removed_mass, from, to, std::clamp(static_cast<int>(rows) / 2, 1, kBatches));
  return result;
}

RateCurve rate_curve(const std::vector<double>& times, const std::vector<double>& accumulated, int windows) {
  RateCurve curve;
  if (times.size() < 2 || windows < 1) return curve;
  const double width = (times.back() - times.front()) / windows;
  for (int w = 0; w < windows; ++w) {
    const double from = times.front() + w * width, to = from + width;
    curve.times.push_back(from + width / 2);
    curve.rates.push_back((interpolated(times, accumulated, to) - interpolated(times, accumulated, from)) / width);
  }
  return curve;
}

}  // namespace postprocess
