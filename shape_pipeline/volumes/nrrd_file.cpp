// SPDX-License-Identifier: GPL-3.0-or-later
// NRRD (Kindlmann 2002, teem.sourceforge.net/nrrd/format.html): a text header, a blank line, the values.
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/volumes/stack_file.h"

namespace shape_pipeline {
namespace {

using Fields = std::map<std::string, std::string>;
constexpr char kRemedy[] = "export it as a NRRD of one file, raw or gzip";

struct Header {
  Fields fields;
  std::size_t bytes = 0;  // up to the values
};

Header read_header(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) refuse_file(path, "", "there is no such file", "check the path of the stack");
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  if (!std::getline(stream, line)) refuse_file(path, "", "the file is empty", "export the stack again");
  if (!line.starts_with("NRRD000")) refuse_file(path, "line 1", "is no NRRD", kRemedy);
  Header header;
  while (std::getline(stream, line)) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) {
      header.bytes = static_cast<std::size_t>(stream.tellg());
      return header;
    }
    const std::size_t colon = line.find(": ");
    if (line[0] != '#' && colon != std::string::npos) header.fields[line.substr(0, colon)] = line.substr(colon + 2);
  }
  if (header.fields.contains("data file") || header.fields.contains("datafile")) return header;
  refuse_file(path, "", "the header does not end: the file is cut off", "export the stack again");
}

std::string field(const std::filesystem::path& path, const Fields& fields, const std::string& name) {
  const auto found = fields.find(name);
  if (found == fields.end()) refuse_file(path, name, "is missing from the header", kRemedy);
  return found->second;
}

SampleType sample_type(const std::filesystem::path& path, const Fields& fields) {
  const std::map<std::string, SampleType> known{{"uint8", {1, false}},
                                                {"uint8_t", {1, false}},
                                                {"uchar", {1, false}},
                                                {"unsigned char", {1, false}},
                                                {"int8", {1, true}},
                                                {"int8_t", {1, true}},
                                                {"signed char", {1, true}},
                                                {"uint16", {2, false}},
                                                {"uint16_t", {2, false}},
                                                {"ushort", {2, false}},
                                                {"unsigned short", {2, false}},
                                                {"int16", {2, true}},
                                                {"int16_t", {2, true}},
                                                {"short", {2, true}},
                                                {"signed short", {2, true}},
                                                {"float", {4, true, false, true}}};
  const auto found = known.find(field(path, fields, "type"));
  if (found == known.end())
    refuse_file(path, "type", "'" + field(path, fields, "type") + "' is not read",
                "save whole numbers of 8 or 16 bits, or float");
  SampleType type = found->second;
  if (type.bytes > 1) type.is_big_endian = field(path, fields, "endian") == "big";
  return type;
}

/// Of the steps along the three axes, nine numbers.
bool are_square_and_right_handed(const std::vector<double>& n) {
  constexpr double kSquare = 1e-3;  // cosine of the angle: headers are written with few digits
  const auto dot = [&](std::size_t a, std::size_t b) {
    return n[3 * a] * n[3 * b] + n[3 * a + 1] * n[3 * b + 1] + n[3 * a + 2] * n[3 * b + 2];
  };
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}})
    if (std::abs(dot(a, b)) > kSquare * std::sqrt(dot(a, a) * dot(b, b))) return false;
  return n[0] * (n[4] * n[8] - n[5] * n[7]) - n[1] * (n[3] * n[8] - n[5] * n[6]) + n[2] * (n[3] * n[7] - n[4] * n[6]) >
         0;
}

/// Lengths of the axes' steps; zeros where the header states none, or no unit for them.
std::array<double, 3> spacing_of(const std::filesystem::path& path, const Fields& fields) {
  const bool has_directions = fields.contains("space directions");
  const std::string unit_key = has_directions ? "space units" : "units";
  if ((!has_directions && !fields.contains("spacings")) || !fields.contains(unit_key)) return {};
  std::string unit = fields.at(unit_key), text = fields.at(has_directions ? "space directions" : "spacings");
  std::replace(unit.begin(), unit.end(), '"', ' ');
  const auto units = words_of(unit);
  const double metres = units.empty() ? 0 : metres_of_unit(units[0]);
  if (metres == 0 || std::any_of(units.begin(), units.end(), [&](auto other) { return other != units[0]; }))
    refuse_file(path, unit_key, "expected one unit of length for the three axes", "correct the header");
  for (const char bracket : {'(', ')'}) std::replace(text.begin(), text.end(), bracket, ' ');
  std::vector<double> numbers;
  const std::size_t expected = has_directions ? 9 : 3;
  std::array<double, 3> spacing{};
  if (append_numbers(text, numbers) && numbers.size() == expected)
    for (std::size_t i = 0; i < 3; ++i)
      spacing[i] =
          metres * (has_directions ? std::hypot(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]) : numbers[i]);
  if (has_directions && numbers.size() == expected && !are_square_and_right_handed(numbers))
    refuse_file(path, "space directions", "expected three axes square to one another that make a right-handed frame",
                "resample the volume on such axes");
  for (const double side : spacing)
    if (!(side > 0) || !std::isfinite(side))
      refuse_file(path, "spacings", "expected the voxel's sides, three numbers above 0", "correct the header");
  return spacing;
}

[[noreturn]] void refuse_surplus(const std::filesystem::path& path) {
  refuse_file(path, "sizes", "the file holds more values than its header says", "correct the header");
}

void read_gzip(const std::filesystem::path& path, std::size_t offset, SampleSink& sink) {
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (!file) refuse_file(path, "", "cannot be opened for reading", "check its permissions");
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> closing(file, std::fclose);
  z_stream stream{};
  if (std::fseek(file, static_cast<long>(offset), SEEK_SET) != 0 || inflateInit2(&stream, 15 + 32) != Z_OK)
    refuse_file(path, "", "cannot be decompressed", kRemedy);
  std::unique_ptr<z_stream, int (*)(z_stream*)> ending(&stream, inflateEnd);
  std::string packed(1 << 16, '\0'),
      slice(sink.grid().index(0, 0, 1) * static_cast<std::size_t>(sink.type().bytes), '\0');
  for (int z = 0; z < sink.grid().size[2]; ++z) {
    stream.next_out = reinterpret_cast<Bytef*>(slice.data());
    stream.avail_out = static_cast<uInt>(slice.size());
    while (stream.avail_out > 0) {
      if (stream.avail_in == 0) {
        stream.next_in = reinterpret_cast<Bytef*>(packed.data());
        stream.avail_in = static_cast<uInt>(std::fread(packed.data(), 1, packed.size(), file));
      }
      const int state = inflate(&stream, Z_NO_FLUSH);
      if (state != Z_OK && !(state == Z_STREAM_END && stream.avail_out == 0))
        refuse_file(path, "slice " + std::to_string(z + 1), "the file is cut off or damaged there",
                    "export the stack again");
    }
    sink.store(sink.grid().index(0, 0, z), slice);
  }
  char more = 0;
  stream.next_out = reinterpret_cast<Bytef*>(&more);
  stream.avail_out = 1;
  if (stream.avail_in == 0) {
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(std::fread(packed.data(), 1, packed.size(), file));
  }
  inflate(&stream, Z_NO_FLUSH);
  if (stream.avail_out == 0) refuse_surplus(path);
}

/// The file that the header names, beside it; empty if the values follow the header.
std::filesystem::path named_file(const std::filesystem::path& path, const Fields& fields) {
  for (const char* skip : {"line skip", "lineskip", "byte skip", "byteskip"})
    if (fields.contains(skip) && fields.at(skip) != "0")
      refuse_file(path, skip, "expected 0, found '" + fields.at(skip) + "'", kRemedy);
  const auto entry = fields.contains("data file") ? fields.find("data file") : fields.find("datafile");
  if (entry == fields.end()) return {};
  const std::filesystem::path name = entry->second;
  if (entry->second == "LIST" || entry->second.find('%') != std::string::npos)
    refuse_file(path, "data file", "the values stand in several files", kRemedy);
  std::filesystem::path values = name.is_absolute() ? name : path.parent_path() / name;
  if (!std::filesystem::is_regular_file(values))
    refuse_file(path, "data file", "there is no file " + values.string(), "put it beside the header");
  if (std::filesystem::equivalent(values, path)) refuse_file(path, "data file", "names the header itself", kRemedy);
  return values;
}

}  // namespace

std::filesystem::path nrrd_values_file(const std::filesystem::path& path) {
  const std::filesystem::path values = named_file(path, read_header(path).fields);
  return values.empty() ? path : values;
}

GreyVolume read_nrrd(const std::filesystem::path& path, double memory_limit) {
  const Header header = read_header(path);
  const Fields& fields = header.fields;
  const std::filesystem::path detached = named_file(path, fields);
  std::vector<double> sizes;
  if (field(path, fields, "dimension") != "3" || !append_numbers(field(path, fields, "sizes"), sizes) ||
      sizes.size() != 3 ||
      std::any_of(sizes.begin(), sizes.end(), [](double n) { return !(n >= 1 && n < 1e5 && n == std::floor(n)); }))
    refuse_file(path, "sizes", "expected a volume of three axes", kRemedy);
  const SampleType type = sample_type(path, fields);
  const std::string encoding = field(path, fields, "encoding");
  if (encoding != "raw" && encoding != "gzip" && encoding != "gz")
    refuse_file(path, "encoding", "'" + encoding + "' is not read", kRemedy);
  SampleSink sink(path, {static_cast<int>(sizes[0]), static_cast<int>(sizes[1]), static_cast<int>(sizes[2])}, type,
                  memory_limit);
  sink.set_spacing(spacing_of(path, fields));
  const std::filesystem::path& values = detached.empty() ? path : detached;
  const std::size_t offset = detached.empty() ? header.bytes : 0;
  if (encoding == "raw" &&
      std::filesystem::file_size(values) - offset > sink.grid().count() * static_cast<std::size_t>(type.bytes))
    refuse_surplus(values);
  if (encoding == "raw")
    sink.store_file(values, offset);
  else
    read_gzip(values, offset, sink);
  return sink.finished();
}

}  // namespace shape_pipeline
