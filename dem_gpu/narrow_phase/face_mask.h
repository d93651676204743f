// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {

/// A set of faces of one part, at most kMaxPartFaces: the outcode of a vertex (planes it lies outside of).
/// Cohen & Sutherland's outcodes, extended to any convex part.
struct FaceMask {
  std::uint64_t word[2] = {0, 0};

  TALUS_HD void insert(int face) { word[face >> 6] |= std::uint64_t{1} << (face & 63); }
  TALUS_HD bool contains(int face) const { return (word[face >> 6] >> (face & 63)) & 1; }
  TALUS_HD bool is_empty() const { return (word[0] | word[1]) == 0; }
  TALUS_HD FaceMask operator&(const FaceMask& b) const { return {{word[0] & b.word[0], word[1] & b.word[1]}}; }
  TALUS_HD FaceMask operator|(const FaceMask& b) const { return {{word[0] | b.word[0], word[1] | b.word[1]}}; }
};
static_assert(kMaxPartFaces <= 128);

}  // namespace dem_gpu
