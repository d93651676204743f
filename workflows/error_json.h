// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "catalog/shape_record.h"

namespace workflows {

/// The figures of a level's error, as ratios; null where one was not measured.
inline nlohmann::ordered_json error_json(const catalog::DecompositionError& error) {
  const auto distance = [](const catalog::SurfaceDistance& surface) {
    return nlohmann::ordered_json{
        {"mean", surface.mean}, {"percentile_95", surface.percentile_95}, {"max", surface.largest}};
  };
  return {{"symmetric_difference", error.symmetric_difference},
          {"method_error", error.method_error},
          {"missing_volume", error.missing_volume},
          {"volume_error", error.volume_error},
          {"surface_mean", error.surface.mean},
          {"surface_percentile_95", error.surface.percentile_95},
          {"surface_max", error.surface.largest},
          {"surface_from_mesh", distance(error.surface_from_mesh)},
          {"surface_from_union", distance(error.surface_from_union)},
          {"centre_error", error.centre_error},
          {"inertia_error", error.inertia_error},
          {"convexity_error", error.convexity_error},
          {"overlap", error.overlap}};
}

}  // namespace workflows
