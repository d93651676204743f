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
  double relative = 0;  // of V, S, M over themselves, where they change by at most kConditioned times the input's
                        // relative change
  double slope = 0;     // of a difference quotient over a step of 1e-3
  double energy = 0;    // of an impact over what it stores: `position` over a depth of 0.02, of either sign
                        // over a hundred steps
  double path = 0;      // of a body over a few smooth contacts: ten times `position`
  double tumble = 0;  // of a body that tumbles over edges and corners: each of some three impacts makes ten times of it
  double touch = 0;  // relative, of a flat impact's time: it begins and ends within kCoplanarity of touch, 1.7e-6 of an
                     // edge twice, over pi times a depth of 0.1
  double late = 0;  // of restitution, where a face lands on a slab 200 times its size: touch is seen 2.8e-6 m late, 6 %
                    // of a step at 20 steps, in which the dashpot takes up to 0.19 of the speed a step
};
inline constexpr SingleRounding kSingle =
    kIsMixed ? SingleRounding{2e-7, 2e-6, 1e-4, 2e-4, 1e-6, 2e-6, 2e-4, 1e-5, 1e-2} : SingleRounding{};

/// The words of a criterion whose tolerance follows kSingle.
inline constexpr const char* by_precision(const char* in_double, const char* in_mixed) {
  return kIsMixed ? in_mixed : in_double;
}

/// Integrals of pairs of bodies against a reference. Up to kConditioned between relative changes of input and result
/// the result is compared as it stands; rounding the input to 1e-16 (single: 6e-8) alone then costs 1e-12 (6e-6).
/// Beyond, the error allowed grows with the factor.
inline constexpr double kConditioned = kIsMixed ? 1e2 : 1e4;
/// Error over the exact value: some ten such roundings.
inline constexpr double kPairGoal = kIsMixed ? 1e-4 : 1e-10;

}  // namespace test_support
