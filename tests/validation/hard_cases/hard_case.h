// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace hard_cases {

/// What came of a case: does its criterion hold, and the figures.
struct Finding {
  bool holds = false;
  std::string got;
};

/// One scene that is known to be hard, and what must come of it: a right end, or a stop that names step, bodies and
/// remedy. A quick one (below a minute) also runs in CTest.
struct HardCase {
  std::string name;
  std::string criterion;
  bool is_quick = true;
  std::function<Finding()> run;
};

std::vector<HardCase> overlap_cases();
std::vector<HardCase> start_cases();
std::vector<HardCase> impact_cases();
std::vector<HardCase> stack_cases();
std::vector<HardCase> long_cases();
std::vector<HardCase> machine_cases();
std::vector<HardCase> repeat_cases();
std::vector<HardCase> kill_cases();  // none where the build has no talus-simulate

/// All of them, in the table's order.
std::vector<HardCase> all_cases();

/// printf into a string.
std::string text(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace hard_cases
