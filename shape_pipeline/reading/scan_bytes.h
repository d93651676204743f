// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace shape_pipeline {

/// Throws InputError "FILE: PLACE: FINDING; REMEDY"; an empty place is left out.
[[noreturn]] void refuse_file(const std::filesystem::path& path, const std::string& place, const std::string& finding,
                              const std::string& remedy);

/// A file's bytes, mapped into memory: what is not looked at takes none, and the system may drop what was. Throws
/// InputError if it is missing, no plain file, unreadable or empty.
class ScanBytes {
 public:
  explicit ScanBytes(const std::filesystem::path& path);
  ~ScanBytes();
  ScanBytes(const ScanBytes&) = delete;
  ScanBytes& operator=(const ScanBytes&) = delete;

  std::string_view view() const { return {data_, size_}; }

 private:
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Steps through the lines of a text, with their numbers.
class TextRows {
 public:
  explicit TextRows(std::string_view text, int lines_before = 0) : rest_(text), line_number_(lines_before) {}

  /// Moves to the next line that is neither blank nor a comment that begins with '#'; false at the end.
  bool next();
  std::string_view row() const { return row_; }
  int line_number() const { return line_number_; }
  std::string place() const { return "line " + std::to_string(line_number_); }

 private:
  std::string_view rest_, row_;
  int line_number_;
};

/// The words of a row, parted by blanks, tabs, commas or semicolons.
std::vector<std::string_view> words_of(std::string_view row);

/// Appends the row's numbers ("nan" and "inf" count as numbers); false if a word is none.
bool append_numbers(std::string_view row, std::vector<double>& numbers);

/// True if the word is a number and nothing else.
bool parse_number(std::string_view word, double& number);

/// At most 24 printable characters of a text, for messages.
std::string excerpt(std::string_view text);

}  // namespace shape_pipeline
