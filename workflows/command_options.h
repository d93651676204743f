// SPDX-License-Identifier: Apache-2.0
#pragma once

// Options of a command line that Talus reads itself, so that a refusal names what is allowed and what was found.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "workflows/stage_tool.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace workflows {

struct WholeRange {
  int least, most;
};

struct NumberRange {
  double least, most;
  bool is_below_most = false;  // the greatest is not allowed itself
};

/// "1,2,4": whole numbers in a range, with commas between them; one that comes again is taken once.
void add_number_list(CLI::App& app, const std::string& name, std::vector<int>& numbers, WholeRange range,
                     const std::string& help);

/// A whole number in a range.
void add_whole_number(CLI::App& app, const std::string& name, int& number, WholeRange range, const std::string& help);

/// A finite number in a range.
void add_number(CLI::App& app, const std::string& name, double& number, NumberRange range, const std::string& help);

/// The same where it matters whether it is given; `if_not_given` is shown in the help.
void add_number(CLI::App& app, const std::string& name, std::optional<double>& number, double if_not_given,
                NumberRange range, const std::string& help);

/// A whole number from 0 to 2^64 - 1.
void add_seed(CLI::App& app, const std::string& name, std::uint64_t& seed, const std::string& help);

/// One of several words; `chosen` gets its place among them.
void add_word(CLI::App& app, const std::string& name, const std::vector<std::string>& words,
              const std::function<void(std::size_t)>& chosen, const std::string& help);

/// For the end of a command line that asked for help or cannot be read: help goes to stdout, an error as
/// "talus decompose: usage: ..." to stderr. Returns the exit status.
ExitStatus ended_status(const CLI::App& app, const CLI::ParseError& error);

}  // namespace workflows
