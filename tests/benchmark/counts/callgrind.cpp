// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/counts/callgrind.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace benchmark_counts {
namespace {

namespace fs = std::filesystem;

/// Within single quotes for the shell; no path here has one.
std::string quoted(const std::string& word) { return "'" + word + "'"; }

/// Of callgrind's output: the line "totals: COUNT".
double counted_total(const fs::path& file) {
  constexpr char kName[] = "totals: ";
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(kName)) return std::stod(line.substr(sizeof kName - 1));
  throw std::runtime_error("callgrind left no count in " + file.string());
}

}  // namespace

double instructions_of(const std::vector<std::string>& command, bool counts_from_start, const fs::path& work_folder) {
  const fs::path output = work_folder / "callgrind.out", said = work_folder / "valgrind.txt";
  fs::remove(output);
  std::string line = "valgrind --tool=callgrind --instr-atstart=" + std::string(counts_from_start ? "yes" : "no") +
                     " --callgrind-out-file=" + quoted(output.string());
  for (const std::string& word : command) line += " " + quoted(word);
  line += " > " + quoted(said.string()) + " 2>&1";
  if (std::system(line.c_str()) != 0)
    throw std::runtime_error(
        "valgrind failed (it is installed by workflows/install_dependencies.sh); it said what is in " + said.string());
  return counted_total(output);
}

}  // namespace benchmark_counts
