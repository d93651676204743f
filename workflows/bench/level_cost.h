// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "catalog/shape_record.h"
#include "dem_gpu/scene.h"

namespace workflows {

/// The level as the engine sees it, at a volume of 1: lengths and depths are then shares of its size.
dem_gpu::Shape unit_shape(const std::string& name, catalog::LevelOfDetail level);

/// Time of a contact of two like bodies of volume 1 under the depth potential over that of two cubes [-], measured.
double measured_contact_cost(const dem_gpu::Shape& body);

/// What the levels of one ladder have in common, as part of a case's name: "64", "64-f34-enclosing".
std::string ladder_name(const catalog::LevelKey& key);

/// The same in words: "64 vertices, 34 faces, enclosing".
std::string ladder_text(const catalog::LevelKey& key);

}  // namespace workflows
