// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace postprocess {

/// Mean of a fluctuating rate over a time window, with a 95 % confidence interval by batch means: the window is cut
/// into equal batches long enough to be nearly independent, whose means scatter as Student's t says
/// (Law & Kelton, Simulation Modeling and Analysis, 2000, section 9.5).
struct IntervalMean {
  double mean = 0;
  double half_width = 0;  // mean +- half_width holds the true mean with 95 % confidence; 0 if batches < 2
  int batches = 0;
  double from_time = 0;  // [s]
  double to_time = 0;    // [s]
};

/// Integral over time of a rate given as averages: averages[i] holds from times[i - 1] to times[i]; averages[0] is
/// not used. Returned at each time, 0 at times[0]. Sizes equal.
std::vector<double> integral_of_averages(const std::vector<double>& times, const std::vector<double>& averages);

/// Linear interpolation of `values` over ascending `times`, held constant outside.
double interpolated(const std::vector<double>& times, const std::vector<double>& values, double time);

/// Mean rate of change of an accumulated quantity between from_time and to_time, in `batches` equal batches.
IntervalMean mean_rate(const std::vector<double>& times, const std::vector<double>& accumulated, double from_time,
                       double to_time, int batches);

/// Two-sided 95 % quantile of Student's t.
double student_t_95(int degrees_of_freedom);

}  // namespace postprocess
