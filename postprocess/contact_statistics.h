// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/snapshot.h"

namespace postprocess {

/// Mean and percentiles of a sample; all zero if it is empty.
struct Spread {
  double mean = 0;
  double median = 0;
  double percentile_90 = 0;
  double percentile_99 = 0;
  double largest = 0;
};

/// The contact network of one snapshot. Only contacts that carry force are in a snapshot.
struct ContactStatistics {
  int active_bodies = 0;
  int body_contacts = 0;           // between two bodies
  int wall_contacts = 0;           // between a body and a wall
  double coordination_number = 0;  // mean number of distinct neighbours that a body touches, walls not counted
  int touching_nothing = 0;        // active bodies without any contact: rattlers and fliers
  Spread force;                    // magnitude of the contact force, normal and friction together [N]
  Spread overlap;                  // depth / equivalent diameter of the smaller body [-]
};

/// Throws catalog::InputError if the snapshot's bodies are not the geometry's.
ContactStatistics contact_statistics(const dem_gpu::RunGeometry& geometry, const dem_gpu::Snapshot& snapshot);

/// Percentiles by linear interpolation between order statistics (Hyndman & Fan 1996, type 7).
Spread spread(std::vector<double> sample);

/// Diameter of the sphere of the body's volume [m].
double equivalent_diameter(const dem_gpu::RunGeometry& geometry, int body);

/// Throws catalog::InputError if the snapshot has other numbers of bodies or walls than the geometry.
void check_same_run(const dem_gpu::RunGeometry& geometry, const dem_gpu::Snapshot& snapshot);

}  // namespace postprocess
