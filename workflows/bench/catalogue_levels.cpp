// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/catalogue_levels.h"

#include <cmath>
#include <set>

#include "catalog/input_error.h"

namespace workflows {

dem_gpu::Shape ShapeLevels::unit_shape(const Level& level) const {
  const catalog::ShapeCatalog shapes(catalogue, catalog::ShapeCatalog::Access::read_only);
  catalog::LevelOfDetail stored = shapes.level(shape.id, level.parts_asked, level.vertex_cap);
  const double size = std::cbrt(stored.mass_properties.volume);
  for (catalog::ConvexPart& part : stored.parts) {
    for (catalog::Point& vertex : part.vertices)
      for (double& x : vertex) x /= size;
    for (catalog::ConvexFace& face : part.faces) face.plane.offset /= size;
  }
  return dem_gpu::polyhedral_shape(shape.name, stored.parts);
}

std::vector<int> ShapeLevels::vertex_caps() const {
  std::set<int> caps;
  for (const Level& level : shape.levels) caps.insert(level.vertex_cap);
  return {caps.begin(), caps.end()};
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
