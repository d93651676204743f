// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/reading/scan_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "catalog/input_error.h"

namespace shape_pipeline {
namespace {

constexpr std::string_view kSeparators = " \t,;\r\f\v";

bool is_separator(char c) { return kSeparators.find(c) != std::string_view::npos; }

}  // namespace

void refuse_file(const std::filesystem::path& path, const std::string& place, const std::string& finding,
                 const std::string& remedy) {
  std::string text = path.string() + ": " + (place.empty() ? "" : place + ": ") + finding + "; " + remedy;
  // Words of the file, such as the key of a sidecar, may hold what would break the line.
  std::replace_if(
      text.begin(), text.end(), [](unsigned char letter) { return letter < ' '; }, '?');
  throw catalog::InputError(text);
}

ScanBytes::ScanBytes(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    refuse_file(path, "", "there is no such file", "check the path of the scan");
  if (std::filesystem::is_directory(path, error))
    refuse_file(path, "", "expected a scan file, found a folder", "name a file in it");
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) refuse_file(path, "", "cannot be opened for reading", "check its permissions");
  struct ::stat state = {};
  const bool has_size = ::fstat(file, &state) == 0;
  size_ = has_size ? static_cast<std::size_t>(state.st_size) : 0;
  void* const mapped = size_ > 0 ? ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0) : MAP_FAILED;
  ::close(file);
  if (has_size && size_ == 0) refuse_file(path, "", "the file is empty", "export the scan again");
  if (mapped == MAP_FAILED) refuse_file(path, "", "reading failed", "check the disk and copy the file again");
  ::madvise(mapped, size_, MADV_SEQUENTIAL);
  data_ = static_cast<const char*>(mapped);
}

ScanBytes::~ScanBytes() { ::munmap(const_cast<char*>(data_), size_); }

bool TextRows::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    row_ = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    ++line_number_;
    while (!row_.empty() && is_separator(row_.front())) row_.remove_prefix(1);
    while (!row_.empty() && is_separator(row_.back())) row_.remove_suffix(1);
    if (!row_.empty() && row_.front() != '#') return true;
  }
  return false;
}

std::vector<std::string_view> words_of(std::string_view row) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin < row.size();) {
    if (is_separator(row[begin])) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < row.size() && !is_separator(row[end])) ++end;
    words.push_back(row.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

bool parse_number(std::string_view word, double& number) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
    number = 0;  // a denormal such as 1e-310 that an exporter wrote for zero
    return true;
  }
  return error == std::errc{} && end == word.data() + word.size();
}

bool append_numbers(std::string_view row, std::vector<double>& numbers) {
  for (const std::string_view word : words_of(row)) {
    double number = 0;
    if (!parse_number(word, number)) return false;
    numbers.push_back(number);
  }
  return true;
}

std::string excerpt(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, 24)) result += c >= ' ' && c <= '~' ? c : '.';
  return "'" + result + (text.size() > 24 ? "...'" : "'");
}

}  // namespace shape_pipeline
