// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/reading/pcd_file.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>

#include "shape_pipeline/reading/scan_bytes.h"

namespace shape_pipeline {
namespace {

constexpr char kExportAgain[] = "copy or export the scan again as PCD";

struct PcdHeader {
  std::map<std::string, std::vector<std::string>, std::less<>> entries;
  std::size_t points = 0, row_bytes = 0, row_words = 0, byte_count = 0;
  std::string storage;  // "ascii", "binary" or "binary_compressed"
};

std::size_t count_of(const std::filesystem::path& path, const PcdHeader& header, const std::string& key) {
  const auto entry = header.entries.find(key);
  double count = -1;
  if (entry == header.entries.end() || entry->second.empty() || !parse_number(entry->second[0], count) ||
      !(count >= 0 && count < 2e9))
    refuse_file(path, "header", "expected a count after " + key, kExportAgain);
  return static_cast<std::size_t>(count);
}

/// PCL 1.13 crashes on header lines of blanks alone; on empty ones it does not.
void refuse_blank_lines(const std::filesystem::path& path, std::string_view header) {
  for (std::size_t begin = 0; begin < header.size();) {
    const std::size_t end = std::min(header.find('\n', begin), header.size());
    const std::string_view line = header.substr(begin, end - begin);
    if (!line.empty() && words_of(line).empty())
      refuse_file(path, "header", "expected no line of blanks or a carriage return alone", "remove it or export again");
    begin = end + 1;
  }
}

PcdHeader parse_header(const std::filesystem::path& path, std::string_view bytes) {
  PcdHeader header;
  TextRows rows(bytes);
  while (header.entries.find("DATA") == header.entries.end()) {
    if (!rows.next()) refuse_file(path, "header", "the DATA line is missing: no PCD file, or truncated", kExportAgain);
    const std::vector<std::string_view> words = words_of(rows.row());
    static const std::string_view known[] = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                             "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
    if (std::find(std::begin(known), std::end(known), words[0]) == std::end(known))
      refuse_file(path, rows.place(), "expected a PCD header line, found " + excerpt(rows.row()),
                  "this is no PCD file; give it the ending of its real format or export it again");
    header.entries[std::string(words[0])] = {words.begin() + 1, words.end()};
  }
  header.byte_count = static_cast<std::size_t>(rows.row().data() + rows.row().size() - bytes.data());
  header.byte_count = std::min(bytes.find('\n', header.byte_count), bytes.size() - 1) + 1;

  refuse_blank_lines(path, bytes.substr(0, header.byte_count));
  const auto& fields = header.entries["FIELDS"];
  const auto& sizes = header.entries["SIZE"];
  auto& counts = header.entries["COUNT"];
  if (counts.empty()) counts.assign(fields.size(), "1");
  if (fields.empty() || sizes.size() != fields.size() || counts.size() != fields.size() ||
      header.entries["TYPE"].size() != fields.size())
    refuse_file(path, "header", "expected as many entries in SIZE, TYPE and COUNT as in FIELDS", kExportAgain);
  for (const char* name : {"x", "y", "z"})
    if (std::find(fields.begin(), fields.end(), name) == fields.end())
      refuse_file(path, "header", std::string("expected the fields x, y and z; ") + name + " is missing", kExportAgain);
  for (std::size_t f = 0; f < fields.size(); ++f) {
    double size = 0, count = 0;
    if (!parse_number(sizes[f], size) || !parse_number(counts[f], count) || !(size >= 1 && size <= 8) ||
        !(count >= 0 && count < 1e6))
      refuse_file(path, "header", "expected numbers in SIZE and COUNT", kExportAgain);
    header.row_bytes += static_cast<std::size_t>(size * count);
    header.row_words += static_cast<std::size_t>(count);
  }
  header.points = count_of(path, header, "WIDTH") * count_of(path, header, "HEIGHT");
  if (header.entries.contains("POINTS") && count_of(path, header, "POINTS") != header.points)
    refuse_file(path, "header", "POINTS is not WIDTH times HEIGHT", kExportAgain);
  if (header.entries["DATA"].empty()) refuse_file(path, "header", "expected a word after DATA", kExportAgain);
  header.storage = header.entries["DATA"][0];
  return header;
}

/// PCL fills what is missing with zeros, so the length is checked here.
void check_body(const std::filesystem::path& path, const PcdHeader& header, std::string_view bytes) {
  const std::string_view body = bytes.substr(header.byte_count);
  const auto refuse_length = [&](const std::string& found) {
    refuse_file(path, "body", "expected " + std::to_string(header.points) + " points, found " + found + ": truncated",
                kExportAgain);
  };
  if (header.storage == "binary") {
    if (body.size() < header.points * header.row_bytes) refuse_length(std::to_string(body.size() / header.row_bytes));
  } else if (header.storage == "binary_compressed") {
    std::uint32_t sizes[2] = {};
    if (body.size() < sizeof sizes) refuse_length("no data");
    std::memcpy(sizes, body.data(), sizeof sizes);
    if (sizes[1] != header.points * header.row_bytes || body.size() - sizeof sizes < sizes[0])
      refuse_length(std::to_string(body.size()) + " bytes of compressed data");
  } else if (header.storage == "ascii") {
    TextRows rows(body);
    std::size_t count = 0;
    std::vector<double> numbers;
    while (rows.next()) {
      numbers.clear();
      if (!append_numbers(rows.row(), numbers) || numbers.size() != header.row_words)
        refuse_file(path, "point " + std::to_string(count + 1),
                    "expected " + std::to_string(header.row_words) + " numbers, found " + excerpt(rows.row()),
                    kExportAgain);
      ++count;
    }
    if (count < header.points) refuse_length(std::to_string(count));
  } else {
    refuse_file(path, "header", "expected DATA ascii, binary or binary_compressed, found " + excerpt(header.storage),
                kExportAgain);
  }
}

/// A floating-point field of a cloud.
struct Column {
  std::size_t offset = 0;
  bool is_double = false;

  double value(const pcl::PCLPointCloud2& cloud, std::size_t row) const {
    const std::uint8_t* const address = &cloud.data[row * cloud.point_step + offset];
    if (!is_double) {
      float single = 0;
      std::memcpy(&single, address, sizeof single);
      return single;
    }
    double number = 0;
    std::memcpy(&number, address, sizeof number);
    return number;
  }
};

std::optional<Column> column(const pcl::PCLPointCloud2& cloud, const std::string& name) {
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name != name) continue;
    const bool is_double = field.datatype == pcl::PCLPointField::FLOAT64;
    if (!is_double && field.datatype != pcl::PCLPointField::FLOAT32) return std::nullopt;
    return Column{field.offset, is_double};
  }
  return std::nullopt;
}

/// The rows of three fields that the sample keeps; none if a field is not there.
std::vector<catalog::Point> columns(const pcl::PCLPointCloud2& cloud, const std::array<const char*, 3>& names,
                                    RowSample sample) {
  std::array<Column, 3> found;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<Column> one = column(cloud, names[i]);
    if (!one) return {};
    found[i] = *one;
  }
  std::vector<catalog::Point> rows;
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  for (std::size_t row = 0; row < count; ++row)
    if (sample.keeps(row))
      rows.push_back({found[0].value(cloud, row), found[1].value(cloud, row), found[2].value(cloud, row)});
  return rows;
}

}  // namespace

SampledCloud read_pcd(const std::filesystem::path& path, std::size_t point_limit) {
  std::size_t total = 0;
  {
    const ScanBytes bytes(path);
    const PcdHeader header = parse_header(path, bytes.view());
    check_body(path, header, bytes.view());
    total = header.points;
  }
  pcl::PCLPointCloud2 stored;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // what is wrong is said below, with the file's name
  bool is_read = false;
  try {
    is_read = pcl::PCDReader().read(path.string(), stored) >= 0;
  } catch (const std::exception&) {
  }
  if (!is_read) refuse_file(path, "", "PCL cannot read this PCD file", kExportAgain);

  const RowSample sample(total, point_limit);
  SampledCloud result{{columns(stored, {"x", "y", "z"}, sample), {}}, total};
  if (result.cloud.points.empty()) refuse_file(path, "header", "expected x, y and z of type F", kExportAgain);
  result.cloud.normals = columns(stored, {"normal_x", "normal_y", "normal_z"}, sample);
  return result;
}

}  // namespace shape_pipeline
