// SPDX-License-Identifier: Apache-2.0
#include "tests/validation/hard_cases/hard_case.h"

#include <cstdarg>
#include <cstdio>

namespace hard_cases {

std::vector<HardCase> all_cases() {
  std::vector<HardCase> all;
  for (const auto& group : {overlap_cases(), start_cases(), impact_cases(), stack_cases(), machine_cases(),
                            repeat_cases(), long_cases(), kill_cases()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

std::string text(const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  return line;
}

}  // namespace hard_cases
