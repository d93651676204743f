// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "shape_pipeline/reading/row_sample.h"

namespace shape_pipeline {

/// Reads a PCD file (ASCII, binary, compressed) in the file's unit through PCL, after checking that the header is whole
/// and the body as long as it says. NaN points stay in. Of more points than the limit a sample is kept.
SampledCloud read_pcd(const std::filesystem::path& path, std::size_t point_limit);

}  // namespace shape_pipeline
