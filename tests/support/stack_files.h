// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <variant>

#include "shape_pipeline/volumes/grey_volume.h"
#include "tests/support/sample_meshes.h"

namespace test_support {

/// An 8-bit RAW and its sidecar with the voxel size in micrometres.
inline void write_raw_stack(const std::filesystem::path& path, const shape_pipeline::GreyVolume& volume) {
  const auto& values = std::get<std::vector<std::uint8_t>>(volume.values);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size()));
  const auto& size = volume.grid.size;
  write_text(std::filesystem::path(path).replace_extension(".json"),
             "{\"size\": [" + std::to_string(size[0]) + ", " + std::to_string(size[1]) + ", " +
                 std::to_string(size[2]) + "], \"type\": \"uint8\", \"voxel_size\": " +
                 std::to_string(volume.grid.spacing[0] * 1e6) + ", \"unit\": \"um\"}");
}

}  // namespace test_support
