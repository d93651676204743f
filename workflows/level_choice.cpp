// SPDX-License-Identifier: Apache-2.0
#include "workflows/level_choice.h"

#include <algorithm>

#include "dem_gpu/contact_cost.h"

namespace workflows {

double contact_cost(const Level& level) { return dem_gpu::contact_cost(level.parts, level.faces); }

std::vector<bool> on_front(const std::vector<Level>& levels) {
  const auto error = [](const Level& level) { return level.error.symmetric_difference; };
  const auto is_beaten_by = [&](const Level& level, const Level& other) {
    const double cost = contact_cost(level), other_cost = contact_cost(other);
    return other_cost <= cost && error(other) <= error(level) && (other_cost < cost || error(other) < error(level));
  };
  std::vector<bool> front;
  for (const Level& level : levels)
    front.push_back(
        std::none_of(levels.begin(), levels.end(), [&](const Level& other) { return is_beaten_by(level, other); }));
  return front;
}

std::optional<Level> cheapest_level(const std::vector<Level>& levels, double tolerance, std::optional<int> vertex_cap) {
  std::optional<Level> cheapest;
  for (const Level& level : levels) {
    if (vertex_cap && level.vertex_cap != *vertex_cap) continue;
    if (!(level.error.symmetric_difference <= tolerance)) continue;
    if (!cheapest || contact_cost(level) < contact_cost(*cheapest)) cheapest = level;
  }
  return cheapest;
}

}  // namespace workflows
