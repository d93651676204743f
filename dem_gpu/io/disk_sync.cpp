// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/io/disk_sync.h"

#include <fcntl.h>
#include <unistd.h>

namespace dem_gpu::io {

bool sync_to_disk(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_synced = fsync(descriptor) == 0;
  close(descriptor);
  return is_synced;
}

}  // namespace dem_gpu::io
