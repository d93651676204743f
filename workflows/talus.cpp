// SPDX-License-Identifier: Apache-2.0
// The front command: talus STAGE ARGUMENTS... becomes the stage's executable, found beside this one.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "workflows/stage_directory.h"
#include "workflows/stage_tool.h"

namespace {

int start(int argc, char** argv) {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::string stage = argc > 1 ? argv[1] : "";
  if (stage == "--help" || stage == "-h" || stage == "help") {
    std::fputs(workflows::front_help(folder).c_str(), stdout);
    return workflows::kDone;
  }
  if (stage == "--version") {
    std::puts(workflows::tool_version().c_str());
    return workflows::kDone;
  }
  if (stage.empty()) {
    std::fputs(workflows::front_help(folder).c_str(), stderr);
    return workflows::kUsage;
  }
  const std::string executable = workflows::stage_executable(folder, stage).string();
  argv[1] = const_cast<char*>(executable.c_str());  // execv leaves its arguments as they are
  execv(executable.c_str(), argv + 1);
  throw std::runtime_error(executable + ": cannot be started: " + std::strerror(errno));
}

}  // namespace

int main(int argc, char** argv) {
  return workflows::run_stage("", [&] { return start(argc, argv); });
}
