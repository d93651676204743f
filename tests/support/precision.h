// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "dem_gpu/core/real.h"

namespace test_support {

inline constexpr bool kIsMixed = std::is_same_v<dem_gpu::LocalReal, float>;

/// What single precision of contact geometry adds to a tolerance stated for double, for bodies of size 1. A coordinate
/// is rounded by up to 6e-8; all are 0 in a build in double precision.
struct SingleRounding {
  double position = 0;  // of a vertex, a plane, a depth: three roundings
  double integral = 0;  // of an integral over clipped polygons of area 1: some ten of them
  double relative =
      0;             // of V, S, M over themselves, where they change by at most 1e2 times the input's relative change
  double slope = 0;  // of a difference quotient over a step of 1e-3
};
inline constexpr SingleRounding kSingle = kIsMixed ? SingleRounding{2e-7, 2e-6, 1e-4, 2e-4} : SingleRounding{};

}  // namespace test_support
