// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "dem_gpu/simulation.h"

namespace workflows {

// Rocks of one shape in a box that is poured full, tilted, and emptied through half of its floor. Lengths are in
// diameters d of the sphere of a rock's volume. The same seed gives the same places and attitudes at every level of
// detail of a shape.

struct BedSize {
  int rocks = 300;
  double length = 10, width = 6;  // along x and y [d]
};

inline constexpr double kRockDiameter = 0.02;  // d [m]
inline constexpr double kBedDensity = 2700;    // [kg/m3]
// Of rocks and walls.
inline constexpr double kBedFriction = 0.5;
inline constexpr double kBedRestitution = 0.3;
// A flat face of a rock that strikes a wall at this speed sinks in by this share of d.
inline constexpr double kPourSpeed = 1.5;  // [m/s]
inline constexpr double kPourOverlap = 0.03;
inline constexpr int kBedSteps = 10;       // in the stiffest contact: preset draft
inline constexpr double kPourTime = 0.4;   // [s]
inline constexpr double kTiltTime = 0.9;   // at most [s]
inline constexpr double kEmptyTime = 0.6;  // [s]
inline constexpr double kFirstTilt = 15;   // [degrees]
inline constexpr double kTiltRate = 50;    // [degrees/s]
inline constexpr double kSlip = 0.2;       // mean way down the slope at which the bed has slid [d]
inline constexpr double kOutlet = 0.5;     // share of the floor that is taken away, on the side of large x

/// Rocks come to rest.
struct PouredBed {
  BedSize size;
  std::vector<dem_gpu::Body> bodies;
  double packing_fraction = 0;  // volume of the rocks / (floor area * twice the height of their common centre) [-]
  double contacts = 0;          // per rock, walls included [-]
  double step_time = 0;         // CPU, mean of the last tenth [s]
  double largest_overlap = 0;   // over d, of the whole run [-]
  double imbalance = 0;         // of energy, over throughput [-]
};

/// `shape`: of volume 1, `reach`: largest bounding radius of all levels to be compared [d]. Throws what
/// dem_gpu::Simulation throws.
PouredBed pour_bed(const dem_gpu::Shape& shape, double reach, std::uint64_t seed, const BedSize& size = {});

/// Tilt at which the rocks have slid by kSlip on the mean, the box turning at kTiltRate from kFirstTilt [degrees];
/// kFailedRun if they do not within kTiltTime.
double slide_angle(const dem_gpu::Shape& shape, const PouredBed& bed);

struct EmptiedBed {
  double half_time = 0;  // until half of the rocks are below the floor [s]; kFailedRun if that is not reached
  double left = 0;       // share of the rocks that stay on the rest of the floor [-]
};
EmptiedBed empty_bed(const dem_gpu::Shape& shape, const PouredBed& bed);

}  // namespace workflows
