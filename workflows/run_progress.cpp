// SPDX-License-Identifier: Apache-2.0
#include "workflows/run_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace workflows {
namespace {

constexpr double kBarSeconds = 0.2;
constexpr double kLineSeconds = 5;
constexpr int kBarWidth = 24;

std::string clock_text(double seconds) {
  const long whole = static_cast<long>(seconds + 0.5);
  char text[48];
  if (whole >= 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%02ld:%02ld", whole / 60, whole % 60);
  return text;
}

}  // namespace

RunProgress::RunProgress(std::int64_t first_step)
    : is_terminal_(isatty(STDERR_FILENO) != 0), first_step_(first_step), start_(Clock::now()), last_shown_(start_) {}

double RunProgress::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

double RunProgress::steps_per_second(std::int64_t step) const {
  const double elapsed = seconds();
  return elapsed > 0 ? double(step - first_step_) / elapsed : 0;
}

std::string RunProgress::show(const RunStatus& status) {
  const Clock::time_point now = Clock::now();
  const bool is_last = status.step >= status.end_step;
  if (std::chrono::duration<double>(now - last_shown_).count() < (is_terminal_ ? kBarSeconds : kLineSeconds) &&
      !is_last)
    return {};
  last_shown_ = now;

  const double speed = steps_per_second(status.step);
  const std::string left = speed > 0 ? clock_text(double(status.end_step - status.step) / speed) : "--:--";
  char energy[48] = "";
  if (status.imbalance_share >= 0)
    std::snprintf(energy, sizeof energy, ", energy off by %.2f %%", 100 * status.imbalance_share);
  char line[200];
  std::snprintf(line, sizeof line, "%.4g / %.4g s, %.3g steps/s, %s left%s", status.time, status.end_time, speed,
                left.c_str(), energy);
  if (is_terminal_) {
    const double share = status.end_step > 0 ? double(status.step) / double(status.end_step) : 1;
    const int filled = std::clamp(static_cast<int>(kBarWidth * share), 0, kBarWidth);
    std::fprintf(stderr, "\r\033[K[%s%s] %s", std::string(static_cast<std::size_t>(filled), '#').c_str(),
                 std::string(static_cast<std::size_t>(kBarWidth - filled), '.').c_str(), line);
    std::fflush(stderr);
    return is_last ? line : "";
  }
  std::fprintf(stderr, "simulate: %s\n", line);
  return line;
}

void RunProgress::finish() const {
  if (is_terminal_) std::fprintf(stderr, "\n");
}

}  // namespace workflows
