// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/core/device_stream.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace dem_gpu {
namespace {

struct StorageBlock {
  char* memory;
  std::size_t bytes;
  bool is_taken;
};

/// Left to the driver when the thread ends: at the end of a program it may be gone before this is.
thread_local std::vector<StorageBlock> storage_blocks;

/// The smallest free block that is large enough; none: end.
std::vector<StorageBlock>::iterator fitting_block(std::size_t bytes) {
  auto best = storage_blocks.end();
  for (auto block = storage_blocks.begin(); block != storage_blocks.end(); ++block)
    if (!block->is_taken && block->bytes >= bytes && (best == storage_blocks.end() || block->bytes < best->bytes))
      best = block;
  return best;
}

/// Blocks that were too small would never serve again in a run that grows.
void free_unused_blocks() {
  for (const StorageBlock& block : storage_blocks)
    if (!block.is_taken) check_device(cudaFree(block.memory), "freeing temporary memory");
  std::erase_if(storage_blocks, [](const StorageBlock& block) { return !block.is_taken; });
}

}  // namespace

void check_device(cudaError_t status, const char* doing) {
  if (status != cudaSuccess)
    throw std::runtime_error(std::string("CUDA: ") + cudaGetErrorName(status) + " (" + cudaGetErrorString(status) +
                             ") while " + doing);
}

void wait_for_device() { check_device(cudaStreamSynchronize(device_stream()), "working off what was launched"); }

char* TemporaryStorage::allocate(std::ptrdiff_t bytes) {
  // Room to grow: candidate pairs come and go from list to list.
  const std::size_t needed = std::max<std::size_t>(static_cast<std::size_t>(bytes), 1 << 16);
  auto block = fitting_block(needed);
  if (block == storage_blocks.end()) {
    free_unused_blocks();
    StorageBlock made{nullptr, needed + needed / 4, false};
    check_device(cudaMalloc(&made.memory, made.bytes), "allocating temporary memory");
    block = storage_blocks.insert(storage_blocks.end(), made);
  }
  block->is_taken = true;
  return block->memory;
}

void TemporaryStorage::deallocate(char* memory, std::size_t /*bytes*/) {
  for (StorageBlock& block : storage_blocks)
    if (block.memory == memory) block.is_taken = false;
}

TemporaryStorage& temporary_storage() {
  thread_local TemporaryStorage storage;
  return storage;
}

}  // namespace dem_gpu
