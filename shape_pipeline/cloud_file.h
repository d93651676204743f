// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "catalog/shape_record.h"
#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

struct CloudReading {
  double metres_per_unit = 1;        // 0.001 for a file in millimetres
  bool drops_nan_points = false;     // drop points with a coordinate that is no number instead of refusing the file
  std::size_t smallest_count = 50;   // fewer points describe no particle
  std::size_t point_limit = 500000;  // of more a sample is kept, one of each run of as many points of the file
};

struct CloudFile {
  PointCloud cloud;
  std::size_t left_out_points = 0;     // by the limit
  std::size_t dropped_nan_points = 0;  // of those read
  std::vector<catalog::Check> notes;  // "subsampled_points", "dropped_nan_points", "given_normals" where there are such
  bool had_unusable_normals = false;  // the columns after x, y, z are no unit vectors (colours, say) and were left out
};

/// Reads PLY (ASCII, binary), PCD (ASCII, binary, compressed) or text rows x y z [nx ny nz] (.xyz, .txt, .asc, .pwn).
/// Throws InputError for a bad file: missing, empty, truncated, of another kind, with NaN points, too few points, all
/// points in one plane or on one line.
CloudFile read_cloud(const std::filesystem::path& path, const CloudReading& reading);

/// Writes a binary little-endian PLY in metres (double precision), with normals if the cloud has them.
void write_cloud(const std::filesystem::path& path, const PointCloud& cloud);

}  // namespace shape_pipeline
