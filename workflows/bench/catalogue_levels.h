// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "catalog/shape_catalog.h"
#include "dem_gpu/scene.h"
#include "workflows/level_choice.h"

namespace workflows {

/// The levels of detail of one shape of a catalogue.
struct ShapeLevels {
  std::filesystem::path catalogue;
  catalog::ShapeSummary shape;  // with its levels, at least one

  /// The level as the engine sees it, at a volume of 1: lengths and depths are then shares of its size.
  dem_gpu::Shape unit_shape(const Level& level) const;
  /// The vertex caps of its levels, ascending.
  std::vector<int> vertex_caps() const;
};

/// All shapes that have levels. Throws catalog::InputError if none has.
std::vector<ShapeLevels> levels_of_catalogue(const std::filesystem::path& catalogue);

}  // namespace workflows
