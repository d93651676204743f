// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "catalog/triangle_mesh.h"

namespace workflows {

/// Reads an STL file, binary or text; corners at the same place become one vertex. Coordinates are multiplied by
/// `metres_per_unit`. Throws catalog::InputError for a file that is missing, empty, cut short or not STL, and for
/// coordinates that are no numbers.
catalog::TriangleMesh read_stl(const std::filesystem::path& path, double metres_per_unit);

}  // namespace workflows
