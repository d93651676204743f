// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dem_gpu {

/// The engine's floating-point type.
using Real = double;

}  // namespace dem_gpu
