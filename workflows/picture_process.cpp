// SPDX-License-Identifier: Apache-2.0
#include "workflows/picture_process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

namespace workflows {
namespace {

/// True if a program of that name is on PATH.
bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

/// Runs a program found on PATH, its output sent to stderr; nothing if it ended with status 0, else why not.
std::string run(std::vector<std::string> command) {
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  pid_t process = 0;
  const int error = posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return command[0] + " could not be started: " + std::strerror(error);
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return command[0] + " was lost: " + std::strerror(errno);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  return "drawing ended with " + (WIFEXITED(status) ? "status " + std::to_string(WEXITSTATUS(status))
                                                    : "signal " + std::to_string(WTERMSIG(status)));
}

}  // namespace

std::string run_with_display(const std::vector<std::string>& arguments) {
  std::vector<std::string> drawing{std::filesystem::read_symlink("/proc/self/exe").string()};
  drawing.insert(drawing.end(), arguments.begin(), arguments.end());
  const char* display = std::getenv("DISPLAY");
  if (display != nullptr && *display != '\0' && run(drawing).empty()) return "";
  if (!is_installed("xvfb-run"))
    return "no display can be opened and xvfb-run is not installed (apt install xvfb xauth)";
  std::vector<std::string> command{"xvfb-run", "-a", "-s", "-screen 0 1280x1024x24"};
  command.insert(command.end(), drawing.begin(), drawing.end());
  return run(command);
}

}  // namespace workflows
