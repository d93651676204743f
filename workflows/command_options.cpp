// SPDX-License-Identifier: Apache-2.0
#include "workflows/command_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <optional>

namespace workflows {
namespace {

/// Nothing if the text is no whole number of that kind, or has more in it.
template <class Number>
std::optional<Number> whole_number(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string joined(const std::vector<int>& numbers) {
  std::string text;
  for (const int number : numbers) text += (text.empty() ? "" : ",") + std::to_string(number);
  return text;
}

std::string short_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

/// "a, b or c"
std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : (k + 1 == words.size() ? " or " : ", ")) + words[k];
  return text;
}

[[noreturn]] void refuse(const std::string& name, const std::string& expected, const std::string& found) {
  throw CLI::ValidationError(name, "expected " + expected + ", found '" + found + "'");
}

CLI::Option* add_number_to(CLI::App& app, const std::string& name, const std::function<void(double)>& take,
                           NumberRange range, const std::string& help) {
  const std::string words =
      short_text(range.least) + (range.is_below_most ? " to below " : " to ") + short_text(range.most);
  const auto read = [take, name, range, words](const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
    if (!is_number || number < range.least || number > range.most || (range.is_below_most && number == range.most))
      refuse(name, "a number from " + words, text);
    take(number);
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("NUMBER from " + words);
}

}  // namespace

void add_number(CLI::App& app, const std::string& name, double& number, NumberRange range, const std::string& help) {
  add_number_to(
      app, name, [&number](double found) { number = found; }, range, help)
      ->default_str(short_text(number));
}

void add_number(CLI::App& app, const std::string& name, std::optional<double>& number, double if_not_given,
                NumberRange range, const std::string& help) {
  add_number_to(
      app, name, [&number](double found) { number = found; }, range, help)
      ->default_str(short_text(if_not_given));
}

void add_number_list(CLI::App& app, const std::string& name, std::vector<int>& numbers, WholeRange range,
                     const std::string& help) {
  const auto read = [&numbers, name, range](const std::string& text) {
    std::vector<int> found;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      const std::optional<int> number = whole_number<int>(text.substr(begin, end - begin));
      if (!number || *number < range.least || *number > range.most)
        refuse(name,
               "whole numbers from " + std::to_string(range.least) + " to " + std::to_string(range.most) +
                   " with commas between them",
               text);
      if (std::find(found.begin(), found.end(), *number) == found.end()) found.push_back(*number);
      begin = end + 1;
    }
    numbers = found;
  };
  CLI::Option* option = app.add_option_function<std::string>(name, read, help)->type_name("N,N,...");
  if (!numbers.empty()) option->default_str(joined(numbers));
}

void add_whole_number(CLI::App& app, const std::string& name, int& number, WholeRange range, const std::string& help) {
  const auto read = [&number, name, range](const std::string& text) {
    const std::optional<int> found = whole_number<int>(text);
    if (!found || *found < range.least || *found > range.most)
      refuse(name, "a whole number from " + std::to_string(range.least) + " to " + std::to_string(range.most), text);
    number = *found;
  };
  app.add_option_function<std::string>(name, read, help)->type_name("N")->default_str(std::to_string(number));
}

void add_seed(CLI::App& app, const std::string& name, std::uint64_t& seed, const std::string& help) {
  const auto read = [&seed, name](const std::string& text) {
    const std::optional<std::uint64_t> number = whole_number<std::uint64_t>(text);
    if (!number)
      refuse(name, "a whole number from 0 to " + std::to_string(std::numeric_limits<std::uint64_t>::max()), text);
    seed = *number;
  };
  app.add_option_function<std::string>(name, read, help)->type_name("N")->default_str(std::to_string(seed));
}

void add_word(CLI::App& app, const std::string& name, const std::vector<std::string>& words,
              const std::function<void(std::size_t)>& chosen, const std::string& help) {
  const auto read = [name, words, chosen](const std::string& text) {
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) refuse(name, alternatives(words), text);
    chosen(static_cast<std::size_t>(found - words.begin()));
  };
  app.add_option_function<std::string>(name, read, help)->type_name("WORD");
}

ExitStatus ended_status(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    app.exit(error, std::cout, std::cerr);
    return kDone;
  }
  std::fprintf(stderr, "%s: usage: %s; see %s --help\n", app.get_name().c_str(), error.what(), app.get_name().c_str());
  return kUsage;
}

}  // namespace workflows
