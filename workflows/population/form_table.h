// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"

namespace workflows {

/// What populations are held against each other by. Names as in docs/descriptors.md, the two ratios being those of
/// axis_short_, axis_intermediate_ and axis_long_inertia.
enum FormFigure : std::size_t { kDiameter, kSOverI, kIOverL, kConvexity, kSphericity, kFormFigures };
inline constexpr std::array<const char*, kFormFigures> kFormNames{"equivalent_diameter_volume", "s_over_i_inertia",
                                                                  "i_over_l_inertia", "convexity_volume_ratio",
                                                                  "sphericity_wadell"};

/// One grain: diameter in metres, the rest ratios.
using FormRow = std::array<double, kFormFigures>;

/// The grains of a population.
struct FormTable {
  std::string source;  // base name of the file
  std::string sha256;  // of a CSV file's bytes, of the figures of a catalogue's shapes
  std::string axes;    // what S, I and L are, in words
  std::vector<FormRow> rows;
};

/// From a catalogue (those of its shapes that `select` names), or from a CSV file with a line of headings. Headings are
/// those of the Sand Atlas, where "Flatness (-)" is S/I and "Elongation (-)" is I/L, or the names above; a length has
/// its unit in brackets, by name alone it is in metres; other columns are passed over. Where a file has axes beside
/// "Flatness" and "Elongation", these must be their ratios: other formulas go by the same names. Throws InputError
/// naming file, line and column for what is missing, no number, or no such figure, and for fewer than 10 grains.
FormTable read_form_table(const std::filesystem::path& file, const std::string& select);

/// Of all shapes that the query names; `file` is for messages.
FormTable form_table(const catalog::ShapeCatalog& catalog, const std::string& select,
                     const std::filesystem::path& file);

/// Of one shape's descriptors; throws InputError naming the shape if one is missing.
FormRow form_row(const std::string& shape, const std::map<std::string, double>& descriptors);

}  // namespace workflows
