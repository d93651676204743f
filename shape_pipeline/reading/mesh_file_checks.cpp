// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/reading/mesh_file_checks.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "shape_pipeline/reading/scan_bytes.h"

namespace shape_pipeline {
namespace {

constexpr std::size_t kStlHeaderBytes = 84;    // 80 of text, 4 of triangle count
constexpr std::size_t kStlTriangleBytes = 50;  // 12 floats and an attribute word
constexpr char kExportAgain[] = "copy or export the mesh again";

/// The row's words from `first` on as finite numbers.
void check_coordinates(const std::filesystem::path& path, const TextRows& rows, std::size_t first) {
  const auto words = words_of(rows.row());
  for (std::size_t w = first; w < first + 3; ++w) {
    double number = 0;
    if (w >= words.size() || !parse_number(words[w], number))
      refuse_file(path, rows.place(), "expected three coordinates, found " + excerpt(rows.row()), kExportAgain);
    if (!std::isfinite(number))
      refuse_file(path, rows.place(), "a coordinate is no number (NaN or infinite)",
                  "clean the mesh and export it again");
  }
}

/// What reads the file afterwards ends its strings at a zero byte.
void check_text(const std::filesystem::path& path, std::string_view bytes) {
  if (const std::size_t zero = bytes.find('\0'); zero != std::string_view::npos)
    refuse_file(path, "byte " + std::to_string(zero), "a zero byte, where text is expected", kExportAgain);
}

void check_ascii_stl(const std::filesystem::path& path, std::string_view bytes) {
  check_text(path, bytes);
  if (bytes.rfind("endsolid") == std::string_view::npos)
    refuse_file(path, "end of file", "'endsolid' is missing: the file is truncated", kExportAgain);
  TextRows rows(bytes);
  std::size_t vertices = 0, facets = 0;
  while (rows.next()) {
    const auto words = words_of(rows.row());
    if (words[0] == "vertex") {
      check_coordinates(path, rows, 1);
      ++vertices;
    } else if (words[0] == "facet") {
      ++facets;
    } else if (words[0] != "solid" && words[0] != "endsolid" && words[0] != "outer" && words[0] != "endloop" &&
               words[0] != "endfacet") {
      refuse_file(path, rows.place(), "expected a line of an ASCII STL, found " + excerpt(rows.row()), kExportAgain);
    }
  }
  if (vertices != 3 * facets || facets == 0)
    refuse_file(path, "",
                "expected three vertices a facet, found " + std::to_string(vertices) + " vertices in " +
                    std::to_string(facets) + " facets",
                kExportAgain);
}

}  // namespace

void check_stl(const std::filesystem::path& path, std::string_view bytes) {
  std::uint32_t triangles = 0;
  if (bytes.size() >= kStlHeaderBytes) std::memcpy(&triangles, bytes.data() + kStlHeaderBytes - 4, sizeof triangles);
  const std::size_t expected = kStlHeaderBytes + kStlTriangleBytes * triangles;
  if (bytes.size() >= kStlHeaderBytes && bytes.size() == expected) {
    if (triangles == 0) refuse_file(path, "header", "the file declares no triangles", kExportAgain);
    return;
  }
  if (bytes.starts_with("solid")) return check_ascii_stl(path, bytes);
  if (bytes.size() < kStlHeaderBytes)
    refuse_file(path, "header", "expected 84 bytes, found " + std::to_string(bytes.size()) + ": truncated or no STL",
                kExportAgain);
  if (triangles > 0 && bytes.size() > expected)
    refuse_file(path, "header",
                "the file has " + std::to_string(bytes.size() - expected) + " bytes more than its " +
                    std::to_string(triangles) + " triangles need",
                kExportAgain);
  refuse_file(path, "header",
              std::to_string(triangles) + " triangles need " + std::to_string(expected) + " bytes, the file has " +
                  std::to_string(bytes.size()) + ": truncated or no STL",
              kExportAgain);
}

void check_obj(const std::filesystem::path& path, std::string_view bytes) {
  TextRows rows(bytes);
  long long vertices = 0;
  std::size_t faces = 0;
  while (rows.next()) {
    const auto words = words_of(rows.row());
    if (words[0] == "v") {
      check_coordinates(path, rows, 1);
      ++vertices;
    } else if (words[0] == "f") {
      if (words.size() < 4)
        refuse_file(path, rows.place(), "expected at least three corners, found " + excerpt(rows.row()), kExportAgain);
      for (std::size_t w = 1; w < words.size(); ++w) {
        double index = 0;
        if (!parse_number(words[w].substr(0, words[w].find('/')), index) || index != std::floor(index))
          refuse_file(path, rows.place(), "expected a vertex index, found " + excerpt(words[w]), kExportAgain);
        if (index == 0 || index < -static_cast<double>(vertices))
          refuse_file(path, rows.place(), "vertex index " + std::string(words[w]) + " is out of range", kExportAgain);
      }
      ++faces;
    } else if (static_cast<unsigned char>(words[0][0]) >= 128 || words[0].find('\0') != std::string_view::npos) {
      refuse_file(path, rows.place(), "expected a line of an OBJ, found " + excerpt(rows.row()),
                  "this is no OBJ file; give it the ending of its real format");
    }
  }
  if (vertices == 0) refuse_file(path, "", "no vertices ('v x y z') found: no OBJ file", kExportAgain);
  if (faces == 0)
    refuse_file(path, "", "no faces ('f i j k') found: truncated, or a point cloud",
                "export the faces too, or save a cloud as .xyz");
  // Faces may stand before their vertices, so the upper bound is checked last.
  TextRows again(bytes);
  while (again.next()) {
    const auto words = words_of(again.row());
    if (words[0] != "f") continue;
    for (std::size_t w = 1; w < words.size(); ++w) {
      double index = 0;
      parse_number(words[w].substr(0, words[w].find('/')), index);
      if (index > static_cast<double>(vertices))
        refuse_file(path, again.place(),
                    "vertex index " + std::string(words[w]) + " is out of range, the file has " +
                        std::to_string(vertices) + " vertices",
                    kExportAgain);
    }
  }
}

void check_off(const std::filesystem::path& path, std::string_view bytes) {
  check_text(path, bytes);
  TextRows rows(bytes);
  if (!rows.next() || words_of(rows.row())[0].find("OFF") == std::string_view::npos)
    refuse_file(path, "line 1", "expected 'OFF', found " + excerpt(rows.row()),
                "this is no OFF file; give it the ending of its real format");
  auto words = words_of(rows.row());
  words.erase(words.begin());
  if (words.empty() && rows.next()) words = words_of(rows.row());
  double vertices = 0, faces = 0;
  if (words.size() < 2 || !parse_number(words[0], vertices) || !parse_number(words[1], faces) || !(vertices >= 1) ||
      !(faces >= 1))
    refuse_file(path, rows.place(), "expected the counts of vertices and faces", kExportAgain);
  for (double v = 0; v < vertices; ++v) {
    if (!rows.next())
      refuse_file(path, "vertex " + std::to_string(static_cast<long long>(v) + 1), "the file ends here: truncated",
                  kExportAgain);
    check_coordinates(path, rows, 0);
  }
  for (double f = 0; f < faces; ++f) {
    if (!rows.next())
      refuse_file(path, "face " + std::to_string(static_cast<long long>(f) + 1), "the file ends here: truncated",
                  kExportAgain);
    const auto corners = words_of(rows.row());
    double count = 0, index = 0;
    if (!parse_number(corners[0], count) || !(count >= 3 && count + 1 <= static_cast<double>(corners.size())))
      refuse_file(path, rows.place(), "expected a face 'n i j k ...', found " + excerpt(rows.row()), kExportAgain);
    for (std::size_t c = 1; c <= static_cast<std::size_t>(count); ++c)
      if (!parse_number(corners[c], index) || !(index >= 0 && index < vertices))
        refuse_file(path, rows.place(), "vertex index " + std::string(corners[c]) + " is out of range", kExportAgain);
  }
}

}  // namespace shape_pipeline
