// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/simulation.h"
#include "tests/support/dem_scenes.h"

namespace test_support {

/// What a single impact left behind.
struct Impact {
  double contact_time = 0;     // [s]
  double largest_overlap = 0;  // [m]
  double peak_force = 0;       // [N]
};

/// Steps until the first contact is over, at most `limit` steps.
inline Impact run_impact(dem_gpu::Simulation& simulation, int limit = 400000) {
  Impact impact;
  int touching = 0;
  for (int i = 0; i < limit; ++i) {
    simulation.advance(1);
    const auto contacts = simulation.snapshot().contacts;
    if (contacts.empty() && touching > 0) break;
    for (const auto& contact : contacts) {
      impact.largest_overlap = std::max(impact.largest_overlap, contact.overlap);
      impact.peak_force = std::max(impact.peak_force, norm(contact.force));
    }
    touching += !contacts.empty();
  }
  impact.contact_time = touching * simulation.time_step();
  return impact;
}

/// Steps to `time`.
inline void run_to(dem_gpu::Simulation& simulation, double time) {
  simulation.advance(std::llround((time - simulation.time()) / simulation.time_step()));
}

/// A slab 0.2 x 0.2 x 0.1 m with its top at z = 0, as a volume object.
inline dem_gpu::Wall slab_wall() {
  dem_gpu::Wall wall;
  wall.name = "slab";
  wall.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.2, 0.2, 0.1}), {}, {0, 0, -0.05})};
  return wall;
}

}  // namespace test_support
