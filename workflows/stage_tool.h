// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace workflows {

/// Exit status of every Talus executable.
enum ExitStatus : int {
  kDone = 0,
  kRunFailed = 1,
  kUsage = 2,
  kBadInput = 3,
  kCheckNotPassed = 4,
  kNoDevice = 5,
  kResumable = 75,
  kInterrupted = 130,
};

/// Runs a stage's body and turns exceptions into one line on stderr and an exit status: UsageError 2, InputError 3,
/// anything else 1. The only place that catches them. The front command itself is the stage "".
int run_stage(const std::string& stage, const std::function<int()>& body);

/// "talus 0.1.0"
std::string tool_version();

/// A line for a batch on stderr: "digitize: [3/12] rock.ply ...". On a terminal it redraws in place.
class BatchProgress {
 public:
  BatchProgress(std::string stage, int total);
  void step(const std::string& item);  // about to work on item
  void note(const std::string& line);  // a full line that stays
  void finish();

 private:
  std::string stage_;
  int total_;
  int done_ = 0;
  bool is_terminal_;
};

}  // namespace workflows
