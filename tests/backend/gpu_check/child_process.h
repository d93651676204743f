// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gpu_check {

struct Command {
  std::vector<std::string> words;        // program and arguments
  std::vector<std::string> environment;  // NAME=value, beside this process's own
  std::filesystem::path log;             // takes stdout and stderr
  double limit = 0;                      // killed with its children after this [s]
};

struct Ending {
  bool started = false;
  int status = -1;  // exit status; 128 + signal if one ended it; 127 if it could not be started
  bool timed_out = false;
  double seconds = 0;
};

/// Runs the commands, `beside` at a time, each in a process group of its own; endings in the commands' order. What
/// `budget` [s] leaves no time for is not started, or killed when it is over.
std::vector<Ending> run_all(const std::vector<Command>& commands, int beside, double budget);

}  // namespace gpu_check
