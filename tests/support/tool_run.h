// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/support/temporary_folder.h"

namespace test_support {

/// What a program that ran in a folder ended with (-1: by a signal) and wrote.
struct ToolRun {
  int status = -1;
  std::string output, errors;
};

/// Runs a command of the shell in the folder.
inline ToolRun run(const TemporaryFolder& folder, const std::string& command) {
  const int ended = std::system(("cd '" + folder.path().string() + "' && " + command + " >out 2>err").c_str());
  return {WIFEXITED(ended) ? WEXITSTATUS(ended) : -1, read_bytes(folder / "out"), read_bytes(folder / "err")};
}

}  // namespace test_support
