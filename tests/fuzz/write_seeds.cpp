// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the seeds into a folder, for libFuzzer to start from: write_seeds FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/reader_seeds.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_seeds FOLDER\n");
    return 2;
  }
  std::filesystem::create_directories(argv[1]);
  int number = 0;
  for (const std::string& seed : fuzz::reader_seeds())
    std::ofstream(std::filesystem::path(argv[1]) / ("seed" + std::to_string(++number)), std::ios::binary) << seed;
  return 0;
}
