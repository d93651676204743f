// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "workflows/population/matched_shapes.h"

namespace CLI {
class App;
}  // namespace CLI

namespace workflows {

/// `talus family population`, as typed.
struct PopulationLine {
  std::filesystem::path reference, catalog_path, plot;
  std::string select, name;  // name: of the shapes, before their number; empty: the reference's
  int count = 0;
  MatchedShapesOptions options;
  bool is_json = false;
};

void declare_population(CLI::App& app, PopulationLine& line);

/// Stores the population and prints how it compares with the reference. Returns the exit status.
int run_population(const PopulationLine& line);

}  // namespace workflows
