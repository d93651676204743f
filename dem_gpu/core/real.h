// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dem_gpu {

/// Positions, orientations, velocities, time, forces, sums and ledger.
using Real = double;

/// Contact geometry: parts in their body frames, clipped polygons and integrals over them, which lie near their own
/// origin. Frame changes between bodies are formed in Real and then rounded. TALUS_PRECISION chooses it.
#if defined(TALUS_MIXED_PRECISION)
using LocalReal = float;
inline constexpr const char* kPrecision = "mixed";
#else
using LocalReal = double;
inline constexpr const char* kPrecision = "double";
#endif

/// A tolerance of contact geometry, which follows the rounding of LocalReal.
constexpr Real local_tolerance(Real in_double, Real in_single) {
  return sizeof(LocalReal) == sizeof(double) ? in_double : in_single;
}

}  // namespace dem_gpu
