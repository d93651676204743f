// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catalog/shape_record.h"
#include "postprocess/svg_plot.h"

namespace postprocess {

using PageColour = std::array<std::uint8_t, 3>;  // red, green, blue

struct PagePicture {
  std::string png;  // bytes
  std::string caption;
};

/// What the colours of a map stand for; even steps of colour from `low` to `high`.
struct ColourScale {
  std::string meaning;
  double low = 0, high = 0;
  std::string unit;
  std::vector<PageColour> colours;  // at least two, that of `low` first
};

struct PageTable {
  std::string title;
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;
};

/// A file or folder that several grains come from: a micrograph, a stack, a plate.
struct SourceEntry {
  std::string name;
  std::vector<std::string> notes;
  std::vector<PagePicture> pictures;
  std::vector<PageTable> tables;
  std::vector<LinePlot> plots;
};

/// One grain, or what was rejected in its place.
struct GrainEntry {
  std::string name;
  std::string refusal;         // why there is no shape; empty if there is one
  int grade = 0;               // see catalog::grade_of()
  catalog::ShapeRecord shape;  // its mesh is not looked at
  std::size_t face_count = 0;
  std::optional<PageColour> colour;  // that the grain has in the pictures of its source
  std::vector<PagePicture> pictures;
  std::optional<ColourScale> scale;  // of the last picture
  std::vector<std::string> notes;    // such as why a picture is missing
};

struct DigitizingReport {
  std::string title;
  std::vector<std::string> notes;
  std::vector<SourceEntry> sources;
  std::vector<GrainEntry> grains;
};

/// One HTML page complete in itself: grades, a table of all grains, the sources, each grain with its pictures, figures,
/// checks and provenance, and what was rejected. The same contents give the same bytes.
std::string digitizing_report_html(const DigitizingReport& report);

}  // namespace postprocess
