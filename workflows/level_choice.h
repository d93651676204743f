// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"

namespace workflows {

using Level = catalog::ShapeSummary::Level;

/// What the engine pays for a contact of such bodies, in contacts of cubes [-].
double contact_cost(const Level& level);

/// Which levels come into question.
struct LevelFilter {
  catalog::FitMode mode = catalog::FitMode::volume_true;
  std::optional<int> vertex_cap{};  // nullopt: any
  std::optional<int> face_cap{};    // 0: none; nullopt: any

  std::vector<Level> operator()(const std::vector<Level>& levels) const;
};

/// "1, 2, 4 parts of at most 32 vertices; 2 parts of at most 64 vertices, enclosing"; "no level" if there is none.
std::string listed(const std::vector<Level>& levels);

/// For each level whether no other of its mode is at most as dear and at most as wrong (symmetric difference): the
/// curve of cost against error.
std::vector<bool> on_front(const std::vector<Level>& levels);

/// The cheapest level whose symmetric difference is at most `tolerance` [-].
std::optional<Level> cheapest_level(const std::vector<Level>& levels, double tolerance);

}  // namespace workflows
