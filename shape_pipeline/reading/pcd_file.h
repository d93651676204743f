// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// Reads a PCD file (ASCII, binary, compressed) in the file's unit through PCL, after checking that the header is whole
/// and the body as long as it says. NaN points stay in.
PointCloud read_pcd(const std::filesystem::path& path);

}  // namespace shape_pipeline
