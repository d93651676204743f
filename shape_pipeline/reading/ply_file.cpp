// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/reading/ply_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <optional>

#include "shape_pipeline/reading/row_sample.h"
#include "shape_pipeline/reading/scan_bytes.h"

namespace shape_pipeline {
namespace {

enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
    case ScalarType::uint8:
      return 1;
    case ScalarType::int16:
    case ScalarType::uint16:
      return 2;
    case ScalarType::int32:
    case ScalarType::uint32:
    case ScalarType::float32:
      return 4;
    case ScalarType::float64:
      return 8;
  }
  return 0;
}

std::optional<ScalarType> scalar_type(std::string_view name) {
  static const std::map<std::string_view, ScalarType> types{
      {"char", ScalarType::int8},      {"int8", ScalarType::int8},       {"uchar", ScalarType::uint8},
      {"uint8", ScalarType::uint8},    {"short", ScalarType::int16},     {"int16", ScalarType::int16},
      {"ushort", ScalarType::uint16},  {"uint16", ScalarType::uint16},   {"int", ScalarType::int32},
      {"int32", ScalarType::int32},    {"uint", ScalarType::uint32},     {"uint32", ScalarType::uint32},
      {"float", ScalarType::float32},  {"float32", ScalarType::float32}, {"double", ScalarType::float64},
      {"float64", ScalarType::float64}};
  const auto entry = types.find(name);
  return entry == types.end() ? std::nullopt : std::optional(entry->second);
}

struct Property {
  std::string name;
  ScalarType type = ScalarType::float32;
  std::optional<ScalarType> list_count_type;  // set for a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  enum class Format { ascii, little_endian, big_endian } format = Format::ascii;
  std::vector<Element> elements;
  std::size_t byte_count = 0;
  int line_count = 0;
};

constexpr char kExportAgain[] = "export the scan again as PLY";

/// Reads the header line by line; any unknown word is an error, since guessing here shifts every number after it.
Header parse_header(const std::filesystem::path& path, std::string_view bytes) {
  if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r"))
    refuse_file(path, "line 1", "expected 'ply', found " + excerpt(bytes.substr(0, bytes.find('\n'))),
                "this is no PLY file; give it the ending of its real format or export it again");
  Header header;
  bool has_format = false;
  for (std::size_t begin = 0;;) {
    const std::size_t end = bytes.find('\n', begin);
    if (end == std::string_view::npos)
      refuse_file(path, "header", "'end_header' is missing: the file is truncated", kExportAgain);
    const std::string_view line = bytes.substr(begin, end - begin);
    const std::vector<std::string_view> words = words_of(line);
    begin = end + 1;
    ++header.line_count;
    const auto refuse_line = [&](const std::string& finding) {
      refuse_file(path, "line " + std::to_string(header.line_count), finding + ", found " + excerpt(line),
                  kExportAgain);
    };
    if (words.empty() || words[0] == "ply" || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") {
      header.byte_count = begin;
      break;
    }
    if (words[0] == "format" && words.size() >= 2) {
      has_format = true;
      if (words[1] == "ascii")
        header.format = Header::Format::ascii;
      else if (words[1] == "binary_little_endian")
        header.format = Header::Format::little_endian;
      else if (words[1] == "binary_big_endian")
        header.format = Header::Format::big_endian;
      else
        refuse_line("expected format ascii, binary_little_endian or binary_big_endian");
    } else if (words[0] == "element" && words.size() == 3) {
      double count = -1;
      if (!parse_number(words[2], count) || !(count >= 0 && count < 2e9)) refuse_line("expected an element count");
      header.elements.push_back({std::string(words[1]), static_cast<std::size_t>(count), {}});
    } else if (words[0] == "property" && !header.elements.empty() && (words.size() == 3 || words.size() == 5)) {
      const bool is_list = words[1] == "list" && words.size() == 5;
      Property property;
      property.name = words.back();
      const auto type = scalar_type(words[is_list ? 3 : 1]);
      const auto count_type = is_list ? scalar_type(words[2]) : std::nullopt;
      if (!type || (is_list && !count_type)) refuse_line("expected a PLY number type");
      property.type = *type;
      property.list_count_type = count_type;
      header.elements.back().properties.push_back(property);
    } else {
      refuse_line("expected 'format', 'comment', 'element', 'property' or 'end_header'");
    }
  }
  if (!has_format) refuse_file(path, "header", "the 'format' line is missing", kExportAgain);
  return header;
}

/// Takes one number after another from the body, ASCII or binary.
class BodyReader {
 public:
  BodyReader(const std::filesystem::path& path, const Header& header, std::string_view bytes)
      : path_(path), format_(header.format), body_(bytes.substr(header.byte_count)) {}

  double take(ScalarType type, const Element& element, std::size_t row) {
    return format_ == Header::Format::ascii ? take_word(element, row) : take_binary(type, element, row);
  }

  /// What stands after the last element: blanks only in an ASCII file, nothing in a binary one.
  std::size_t bytes_left() const {
    if (format_ != Header::Format::ascii) return body_.size() - offset_;
    const std::size_t next = body_.find_first_not_of(" \t\r\n", offset_);
    return next == std::string_view::npos ? 0 : body_.size() - next;
  }

 private:
  [[noreturn]] void refuse_truncated(const Element& element, std::size_t row) const {
    refuse_file(path_, element.name + " " + std::to_string(row + 1) + " of " + std::to_string(element.count),
                "the file ends here: it is truncated", "copy or export the scan again");
  }

  double take_word(const Element& element, std::size_t row) {
    const std::size_t begin = body_.find_first_not_of(" \t\r\n", offset_);
    if (begin == std::string_view::npos) refuse_truncated(element, row);
    const std::size_t end = std::min(body_.find_first_of(" \t\r\n", begin), body_.size());
    const std::string_view word = body_.substr(begin, end - begin);
    offset_ = end;
    double number = 0;
    if (!parse_number(word, number))
      refuse_file(path_, element.name + " " + std::to_string(row + 1), "expected a number, found " + excerpt(word),
                  kExportAgain);
    return number;
  }

  double take_binary(ScalarType type, const Element& element, std::size_t row) {
    const std::size_t size = size_of(type);
    if (body_.size() - offset_ < size) refuse_truncated(element, row);
    unsigned char raw[8];
    std::memcpy(raw, body_.data() + offset_, size);
    offset_ += size;
    const bool is_foreign = (format_ == Header::Format::big_endian) == (std::endian::native == std::endian::little);
    if (is_foreign) std::reverse(raw, raw + size);
    switch (type) {
      case ScalarType::int8:
        return as<std::int8_t>(raw);
      case ScalarType::uint8:
        return as<std::uint8_t>(raw);
      case ScalarType::int16:
        return as<std::int16_t>(raw);
      case ScalarType::uint16:
        return as<std::uint16_t>(raw);
      case ScalarType::int32:
        return as<std::int32_t>(raw);
      case ScalarType::uint32:
        return as<std::uint32_t>(raw);
      case ScalarType::float32:
        return as<float>(raw);
      case ScalarType::float64:
        return as<double>(raw);
    }
    return 0;
  }

  template <class Number>
  static double as(const unsigned char* raw) {
    Number number;
    std::memcpy(&number, raw, sizeof number);
    return static_cast<double>(number);
  }

  const std::filesystem::path& path_;
  Header::Format format_;
  std::string_view body_;
  std::size_t offset_ = 0;
};

/// Where a vertex property goes: 0 to 2 for x, y, z; 3 to 5 for the normal; -1 for anything else.
int vertex_column(const std::string& name) {
  static const char* const names[] = {"x", "y", "z", "nx", "ny", "nz"};
  const auto entry = std::find(std::begin(names), std::end(names), name);
  return entry == std::end(names) ? -1 : static_cast<int>(entry - std::begin(names));
}

void check_vertex_columns(const std::filesystem::path& path, const Header& header, bool& has_normals) {
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const Element& element) { return element.name == "vertex"; });
  if (vertex == header.elements.end() || vertex->count == 0)
    refuse_file(path, "header", "expected 'element vertex' with at least one vertex", kExportAgain);
  bool is_there[6] = {};
  for (const Property& property : vertex->properties) {
    const int column = vertex_column(property.name);
    if (column >= 0 && !property.list_count_type) is_there[column] = true;
  }
  if (!is_there[0] || !is_there[1] || !is_there[2])
    refuse_file(path, "header", "expected the vertex properties x, y and z", kExportAgain);
  has_normals = is_there[3] && is_there[4] && is_there[5];
}

}  // namespace

std::size_t ply_face_count(const std::filesystem::path& path) {
  const Header header = parse_header(path, ScanBytes(path).view());
  std::size_t faces = 0;
  for (const Element& element : header.elements)
    if (element.name == "face") faces += element.count;
  return faces;
}

PlyContents read_ply(const std::filesystem::path& path, std::size_t vertex_limit) {
  const ScanBytes bytes(path);
  const Header header = parse_header(path, bytes.view());
  bool has_normals = false;
  check_vertex_columns(path, header, has_normals);

  PlyContents contents;
  BodyReader body(path, header, bytes.view());
  for (const Element& element : header.elements) {
    const bool is_vertex = element.name == "vertex";
    RowSample sample(element.count, vertex_limit);
    if (is_vertex) contents.vertex_count = element.count;
    for (std::size_t row = 0; row < element.count; ++row) {
      double column[6] = {};
      for (const Property& property : element.properties) {
        if (!property.list_count_type) {
          const double number = body.take(property.type, element, row);
          const int target = vertex_column(property.name);
          if (target >= 0) column[target] = number;
          continue;
        }
        const double count = body.take(*property.list_count_type, element, row);
        if (!(count >= 0 && count < 1e6))
          refuse_file(path, element.name + " " + std::to_string(row + 1), "expected a list length", kExportAgain);
        std::vector<std::int64_t> list;
        for (int entry = 0; entry < count; ++entry)
          list.push_back(static_cast<std::int64_t>(body.take(property.type, element, row)));
        if (element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index"))
          contents.faces.push_back(std::move(list));
      }
      if (is_vertex && sample.keeps(row)) {
        contents.points.push_back({column[0], column[1], column[2]});
        if (has_normals) contents.normals.push_back({column[3], column[4], column[5]});
      }
    }
  }
  if (body.bytes_left() > 0)
    refuse_file(path, "end of file", std::to_string(body.bytes_left()) + " bytes more than the header declares",
                kExportAgain);
  return contents;
}

}  // namespace shape_pipeline
