// SPDX-License-Identifier: Apache-2.0
// Runs the hard cases and prints their Markdown table: hard_cases [--quick] [--only TEXT]. Exit status 4 if one fails.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>

#include "tests/support/threads.h"
#include "tests/validation/hard_cases/hard_case.h"

namespace {

hard_cases::Finding finding_of(const hard_cases::HardCase& one) {
  try {
    return one.run();
  } catch (const std::exception& error) {
    return {false, std::string("stopped: ") + error.what()};
  }
}

}  // namespace

int main(int argc, char** argv) {
  bool only_quick = false;
  std::string part;
  for (int i = 1; i < argc; ++i) {
    only_quick |= std::strcmp(argv[i], "--quick") == 0;
    if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) part = argv[++i];
  }
  const test_support::ThreadLimit one_thread(1);
  int failed = 0, count = 0;
  std::printf("| case | criterion | got | verdict | seconds |\n|---|---|---|---|---|\n");
  for (const hard_cases::HardCase& one : hard_cases::all_cases()) {
    if ((only_quick && !one.is_quick) || one.name.find(part) == std::string::npos) continue;
    const auto before = std::chrono::steady_clock::now();
    const hard_cases::Finding finding = finding_of(one);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    std::printf("| %s | %s | %s | %s | %.1f |\n", one.name.c_str(), one.criterion.c_str(), finding.got.c_str(),
                finding.holds ? "holds" : "**fails**", seconds);
    std::fflush(stdout);
    failed += !finding.holds;
    ++count;
  }
  std::printf("\n%d of %d cases hold.\n", count - failed, count);
  return failed == 0 ? 0 : 4;
}
