// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "workflows/scene_assembly.h"

namespace workflows {

/// resolved_scene.json: the scene as understood, in SI, with everything worked out. `scene_folder` is where relative
/// paths of the scene file start, kept for a resumed run.
nlohmann::ordered_json resolved_scene(const AssembledScene& assembled, const SceneDescription& description,
                                      const std::string& scene_folder);

/// The scene's shapes with their counts and errors, as they stand in resolved_scene.json and run.json.
nlohmann::ordered_json shapes_json(const AssembledScene& assembled);

}  // namespace workflows
