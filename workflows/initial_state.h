// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem_gpu/mesh_probe.h"
#include "dem_gpu/scene.h"

namespace workflows {

/// A body's bounding ball at time 0, and the fill it came from.
struct InitialBall {
  dem_gpu::Vec3 centre;  // [m]
  double radius = 0;     // [m]
  int group = 0;         // balls of one group are known to be apart
};

/// One line on two balls of different groups that overlap; empty if none do. `group_names` for the line.
std::string overlapping_balls(const std::vector<InitialBall>& balls, const std::vector<std::string>& group_names);

/// How far balls reach into a wall at time 0.
class WallReach {
 public:
  explicit WallReach(const dem_gpu::Wall& wall);
  /// 0 or less if the ball is clear of the wall [m]. Beside a surface's finite extent there is no wall.
  double reach_of(const dem_gpu::Vec3& centre, double radius) const;

 private:
  const dem_gpu::Wall& wall_;
  std::optional<dem_gpu::MeshProbe> mesh_;
};

}  // namespace workflows
