// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/core/pass.h"
#include "dem_gpu/shapes/shape_columns.h"

namespace dem_gpu {

/// Two bodies, or a body and a wall, of a scene.
struct StartPair {
  ContactKind kind;
  int a, b;
  Vec3 shift_b{};  // to where a meets b, across a face of a periodic box [m]

  bool has_wall() const { return is_wall_kind(kind); }
};

/// A pair with all else of its scene away, at rest at time 0, without gravity, damping and friction. b, or the wall,
/// stays; a is moved about.
class LonePair {
 public:
  /// `shapes`: the columns of the whole scene's shapes.
  LonePair(const Model& whole, const HostShapeColumns& shapes, const StartPair& pair);

  /// Elastic force on a when it is `shift` away from its place [N]; zero where the two do not touch.
  Vec3 force_at(const Vec3& shift);

 private:
  BodyColumns at_start_;
  Model model_;
  std::vector<std::unique_ptr<Pass>> passes_;
  Vec3 place_;  // of a in its scene [m]
};

}  // namespace dem_gpu
