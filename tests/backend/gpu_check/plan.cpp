// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/gpu_check/plan.h"

#include <fstream>
#include <functional>
#include <sstream>

#include "catalog/input_error.h"

namespace gpu_check {
namespace {

/// Calls take(words) for each line that is neither empty nor a comment; it returns whether they are what is expected.
void read_lines(const std::filesystem::path& file, const std::string& expected,
                const std::function<bool(std::istringstream&)>& take) {
  std::ifstream text(file);
  if (!text) throw catalog::InputError(file.string() + ": cannot be read; make gpu-check writes the folder");
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    if (!take(words))
      throw catalog::InputError(file.string() + ":" + std::to_string(number) + ": expected " + expected);
  }
}

}  // namespace

std::vector<TestProgram> read_tests(const std::filesystem::path& file) {
  std::vector<TestProgram> tests;
  read_lines(file, "NAME LABEL", [&](std::istringstream& words) {
    TestProgram& test = tests.emplace_back();
    return static_cast<bool>(words >> test.name >> test.label);
  });
  return tests;
}

std::vector<Bench> read_benches(const std::filesystem::path& file) {
  std::vector<Bench> benches;
  read_lines(file, "NAME SECONDS ARGUMENTS...", [&](std::istringstream& words) {
    Bench& bench = benches.emplace_back();
    words >> bench.name >> bench.limit;
    const bool is_good = static_cast<bool>(words);
    for (std::string word; words >> word;) bench.arguments.push_back(word);
    return is_good && bench.limit > 0 && !bench.arguments.empty();
  });
  return benches;
}

}  // namespace gpu_check
