// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/bulk/bulk_cases.h"

namespace workflows {

void set_law(dem_gpu::Scene& scene, const NamedLaw& law, double speed, double flat_overlap) {
  if (law.is_volume)
    scene.polyhedral_law = dem_gpu::OverlapVolume{1};
  else
    scene.polyhedral_law = dem_gpu::DepthPotential{1};
  const double stiffness = dem_gpu::stiffness_for_overlap(scene, speed, flat_overlap);
  std::visit([&](auto& chosen) { chosen.stiffness = stiffness; }, scene.polyhedral_law);
}

dem_gpu::Wall plane_wall(const std::string& name, const dem_gpu::Vec3& point, const dem_gpu::Vec3& normal) {
  dem_gpu::Wall wall;
  wall.name = name;
  wall.geometry = dem_gpu::Plane{point, normal};
  return wall;
}

std::string steps_label(int steps) { return std::to_string(steps) + " steps"; }

}  // namespace workflows
