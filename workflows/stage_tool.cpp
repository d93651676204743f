// SPDX-License-Identifier: Apache-2.0
#include "workflows/stage_tool.h"

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <utility>

#include "catalog/input_error.h"

namespace workflows {

int run_stage(const std::string& stage, const std::function<int()>& body) {
  const auto report = [&](const char* kind, const std::exception& error, ExitStatus status) -> int {
    std::fprintf(stderr, "talus%s%s: %s%s\n", stage.empty() ? "" : " ", stage.c_str(), kind, error.what());
    return status;
  };
  try {
    return body();
  } catch (const catalog::UsageError& error) {
    return report("usage: ", error, kUsage);
  } catch (const catalog::InputError& error) {
    return report("bad input: ", error, kBadInput);
  } catch (const std::exception& error) {
    return report("failed: ", error, kRunFailed);
  }
}

std::string tool_version() { return std::string("talus ") + TALUS_VERSION; }

BatchProgress::BatchProgress(std::string stage, int total)
    : stage_(std::move(stage)), total_(total), is_terminal_(isatty(STDERR_FILENO) != 0) {}

void BatchProgress::step(const std::string& item) {
  ++done_;
  std::fprintf(stderr, is_terminal_ ? "\r\033[K%s: [%d/%d] %s" : "%s: [%d/%d] %s\n", stage_.c_str(), done_, total_,
               item.c_str());
  std::fflush(stderr);
}

void BatchProgress::note(const std::string& line) {
  std::fprintf(stderr, is_terminal_ ? "\r\033[K%s: %s\n" : "%s: %s\n", stage_.c_str(), line.c_str());
}

void BatchProgress::finish() {
  if (is_terminal_) std::fprintf(stderr, "\r\033[K");
}

}  // namespace workflows
