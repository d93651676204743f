// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gpu_check {

// What the folder that make gpu-check builds holds beside the programs: tests.txt, a line "NAME LABEL" a test program;
// benches.txt, a line "NAME SECONDS ARGUMENTS..." a run of time_scene; reference/, what the CPU computed.

struct TestProgram {
  std::string name, label;
};

struct Bench {
  std::string name;
  double limit = 0;  // [s]
  std::vector<std::string> arguments;
};

/// Throw catalog::InputError naming file and line.
std::vector<TestProgram> read_tests(const std::filesystem::path& file);
std::vector<Bench> read_benches(const std::filesystem::path& file);

}  // namespace gpu_check
