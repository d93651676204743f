// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/gpu_check/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace gpu_check {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kNotStarted = 127;
constexpr auto kLookAgain = std::chrono::milliseconds(5);

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Pointers to the words, and null.
std::vector<char*> pointers_to(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// What is given stands before what this process has, so that it is found first.
std::vector<char*> environment_of(const Command& command) {
  std::vector<char*> pointers = pointers_to(command.environment);
  pointers.pop_back();
  for (char** one = environ; *one != nullptr; ++one) pointers.push_back(*one);
  pointers.push_back(nullptr);
  return pointers;
}

/// What is between fork and exec allocates nothing: other threads may hold the allocator's lock.
pid_t start(const Command& command) {
  const std::vector<char*> words = pointers_to(command.words), environment = environment_of(command);
  const int log = open(command.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  const pid_t process = fork();
  if (process == 0) {
    setpgid(0, 0);
    if (log >= 0) {
      dup2(log, STDOUT_FILENO);
      dup2(log, STDERR_FILENO);
    }
    execvpe(words[0], words.data(), environment.data());
    _exit(kNotStarted);
  }
  if (process > 0) setpgid(process, process);
  if (log >= 0) close(log);
  return process;
}

Ending run(const Command& command, double limit) {
  const Clock::time_point begin = Clock::now();
  Ending ending;
  const pid_t process = start(command);
  if (process < 0) {
    ending.status = kNotStarted;
    return ending;
  }
  ending.started = true;
  int status = 0;
  while (waitpid(process, &status, WNOHANG) == 0) {
    if (!ending.timed_out && seconds_since(begin) > limit) {
      ending.timed_out = true;
      kill(-process, SIGKILL);
    }
    std::this_thread::sleep_for(kLookAgain);
  }
  ending.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ending.seconds = seconds_since(begin);
  return ending;
}

}  // namespace

std::vector<Ending> run_all(const std::vector<Command>& commands, int beside, double budget) {
  const Clock::time_point begin = Clock::now();
  std::vector<Ending> endings(commands.size());
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> workers;
  for (int worker = 0; worker < beside; ++worker)
    workers.emplace_back([&] {
      for (std::size_t i = next++; i < commands.size(); i = next++) {
        const double left = budget - seconds_since(begin);
        if (left > 0) endings[i] = run(commands[i], std::min(left, commands[i].limit));
      }
    });
  workers.clear();
  return endings;
}

}  // namespace gpu_check
