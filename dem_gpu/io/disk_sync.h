// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace dem_gpu::io {

/// Flushes a file or folder to the disk; false with errno set if that fails.
bool sync_to_disk(const std::filesystem::path& path);

}  // namespace dem_gpu::io
