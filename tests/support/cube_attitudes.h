// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/dem_scenes.h"

namespace test_support {

/// How a cube strikes what is below it.
struct Attitude {
  const char* name;
  Quaternion orientation;
  Real half_height;  // of the cube as it stands [m]
};

/// Of a cube of that edge [m]: face, edge, corner down.
inline std::array<Attitude, 3> cube_attitudes(Real edge) {
  return {{{"face", {}, edge / 2},
           {"edge", edge_down(), edge / std::numbers::sqrt2_v<Real>},
           {"corner", vertex_down(), edge * std::sqrt(Real(3)) / 2}}};
}

}  // namespace test_support
