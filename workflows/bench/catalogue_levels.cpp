// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/catalogue_levels.h"

#include <algorithm>

#include "catalog/input_error.h"
#include "workflows/bench/level_cost.h"

namespace workflows {

dem_gpu::Shape ShapeLevels::unit_shape(const Level& level) const {
  const catalog::ShapeCatalog shapes(catalogue, catalog::ShapeCatalog::Access::read_only);
  return workflows::unit_shape(shape.name, shapes.level(shape.id, level.key));
}

std::vector<std::pair<std::string, std::vector<Level>>> ShapeLevels::ladders() const {
  std::vector<std::pair<std::string, std::vector<Level>>> all;
  for (const Level& level : shape.levels) {
    const std::string name = ladder_name(level.key);
    const auto known = std::find_if(all.begin(), all.end(), [&](const auto& ladder) { return ladder.first == name; });
    if (known == all.end())
      all.push_back({name, {level}});
    else
      known->second.push_back(level);
  }
  return all;
}

std::vector<ShapeLevels> levels_of_catalogue(const std::filesystem::path& catalogue) {
  const catalog::ShapeCatalog shapes(catalogue, catalog::ShapeCatalog::Access::read_only);
  std::vector<ShapeLevels> all;
  for (const catalog::ShapeId id : shapes.select("")) {
    ShapeLevels one{catalogue, shapes.summary(id)};
    if (!one.shape.levels.empty()) all.push_back(std::move(one));
  }
  if (all.empty())
    throw catalog::InputError(catalogue.string() + ": has no levels of detail; make them with talus decompose");
  return all;
}

}  // namespace workflows
