// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "catalog/shape_catalog.h"
#include "dem_gpu/scene.h"
#include "workflows/level_choice.h"

namespace workflows {

/// The levels of detail of one shape of a catalogue.
struct ShapeLevels {
  std::filesystem::path catalogue;
  catalog::ShapeSummary shape;  // with its levels, at least one

  /// See unit_shape() of level_cost.h.
  dem_gpu::Shape unit_shape(const Level& level) const;
  /// Its levels by what they have in common beside the number of parts (see ladder_name()), the usual ones first.
  std::vector<std::pair<std::string, std::vector<Level>>> ladders() const;
};

/// All shapes that have levels. Throws catalog::InputError if none has.
std::vector<ShapeLevels> levels_of_catalogue(const std::filesystem::path& catalogue);

}  // namespace workflows
