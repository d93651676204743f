// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "workflows/scene_assembly.h"

namespace workflows {

/// Settings of a scene file that nothing in the scene feels, one line each with its place: properties of sphere
/// contacts in a scene without spheres, of contacts of polyhedra in one without polyhedra, materials and motions that
/// nothing has.
std::vector<std::string> idle_settings(const SceneDescription& description, const dem_gpu::Scene& scene);

}  // namespace workflows
