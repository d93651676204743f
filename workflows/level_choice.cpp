// SPDX-License-Identifier: Apache-2.0
#include "workflows/level_choice.h"

#include <algorithm>
#include <utility>

#include "dem_gpu/contact_cost.h"

namespace workflows {

std::vector<Level> LevelFilter::operator()(const std::vector<Level>& levels) const {
  std::vector<Level> kept;
  for (const Level& level : levels)
    if (level.key.mode == mode && level.key.vertex_cap == vertex_cap.value_or(level.key.vertex_cap) &&
        level.key.face_cap == face_cap.value_or(level.key.face_cap))
      kept.push_back(level);
  return kept;
}

std::string listed(const std::vector<Level>& levels) {
  std::vector<std::pair<std::string, std::string>> kinds;  // limits, numbers of parts
  for (const Level& level : levels) {
    const std::string limits = described_limits(level.key), parts = std::to_string(level.key.parts_asked);
    const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return kind.first == limits; });
    if (known == kinds.end())
      kinds.emplace_back(limits, parts);
    else
      known->second += ", " + parts;
  }
  std::string text;
  for (const auto& [limits, parts] : kinds)
    text += (text.empty() ? "" : "; ") + parts + (parts == "1" ? " part " : " parts ") + limits;
  return text.empty() ? "no level" : text;
}

double contact_cost(const Level& level) { return dem_gpu::contact_cost(level.parts, level.faces); }

std::vector<bool> on_front(const std::vector<Level>& levels) {
  const auto error = [](const Level& level) { return level.error.symmetric_difference; };
  const auto is_beaten_by = [&](const Level& level, const Level& other) {
    if (other.key.mode != level.key.mode) return false;
    const double cost = contact_cost(level), other_cost = contact_cost(other);
    return other_cost <= cost && error(other) <= error(level) && (other_cost < cost || error(other) < error(level));
  };
  std::vector<bool> front;
  for (const Level& level : levels)
    front.push_back(
        std::none_of(levels.begin(), levels.end(), [&](const Level& other) { return is_beaten_by(level, other); }));
  return front;
}

std::optional<Level> cheapest_level(const std::vector<Level>& levels, double tolerance) {
  std::optional<Level> cheapest;
  for (const Level& level : levels) {
    if (!(level.error.symmetric_difference <= tolerance)) continue;
    if (!cheapest || contact_cost(level) < contact_cost(*cheapest)) cheapest = level;
  }
  return cheapest;
}

}  // namespace workflows
