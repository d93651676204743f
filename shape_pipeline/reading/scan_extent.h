// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Throws InputError if all points lie in one place, on one line or in one plane (to 1e-4 of their spread).
void refuse_flat_scan(const std::filesystem::path& path, const std::vector<catalog::Point>& points);

}  // namespace shape_pipeline
