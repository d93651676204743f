// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Whether all points lie in one place, on one line or in one plane (to 1e-4 of their spread).
bool are_flat(const std::vector<catalog::Point>& points);

/// Throws InputError if all points lie in one place, on one line or in one plane (to 1e-4 of their spread).
void refuse_flat_scan(const std::filesystem::path& path, const std::vector<catalog::Point>& points);

/// Throws InputError if points [m] spread over less than 1e-12 m or lie beyond 1e12 m: the unit is wrong, and moments
/// of inertia, fifth powers of a length, would soon leave the range of numbers.
void refuse_impossible_size(const std::filesystem::path& path, const std::vector<catalog::Point>& points);

}  // namespace shape_pipeline
