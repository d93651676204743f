// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace architecture {

/// Text of each source file by its path from the repository root, with '/' between folders.
using SourceTree = std::map<std::string, std::string>;

/// Headers and sources of the module folders below `root`.
SourceTree read_modules(const std::filesystem::path& root);

/// The same of everything below `root`/tests.
SourceTree read_tests(const std::filesystem::path& root);

struct Include {
  int line = 0;
  std::string path;
  bool is_quoted = false;
};
/// The #include lines of a source, those in comments left out.
std::vector<Include> includes_of(const std::string& text);

/// One line each, "FILE:LINE: what is wrong", for includes that the arrows between modules do not allow.
std::vector<std::string> violations(const SourceTree& tree);

/// Sources outside the engine that reach dem_gpu/core/parallel.h, through whatever headers, and so can launch kernels.
/// With the CUDA back end such a source must be compiled by nvcc, which only a build with nvcc and all tests would
/// tell.
std::vector<std::string> sources_with_kernels(const SourceTree& tree);

}  // namespace architecture
