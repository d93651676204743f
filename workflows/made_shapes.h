// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"

namespace workflows {

/// A shape to be made and stored under a name, with the provenance that tells whether it is there already.
struct ShapeOrder {
  std::string name;
  catalog::Provenance provenance;
  std::function<catalog::ShapeRecord()> make;
};

struct MadeShape {
  std::string name, status;  // "stored" or "skipped": there from the same source, options and version
  catalog::ShapeSummary summary;
};

/// Makes and stores the shapes, one after the other; what is there already is left alone.
std::vector<MadeShape> make_shapes(catalog::ShapeCatalog& catalog, const std::vector<ShapeOrder>& orders);

/// Prints a table, or a JSON object a line, of the shapes. Returns the exit status: done, or a check did not pass.
int report_made_shapes(const std::string& stage, const std::vector<MadeShape>& shapes, bool is_json);

/// The catalogue to fill; refuses an empty file, which SQLite would take for a new database.
catalog::ShapeCatalog catalogue_to_fill(const std::filesystem::path& path);

/// Of the option: a length above 0; throws InputError naming the option.
double positive_length(const std::string& option, const std::string& text);

}  // namespace workflows
