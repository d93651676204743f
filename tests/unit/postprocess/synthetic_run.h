// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "dem_gpu/snapshot.h"

namespace test_support {

// Run folders made up by formula, in every file as the simulate stage leaves them.

/// What went into the mill's series.
struct MillTruth {
  double angular_speed = 2.5;  // about +y [rad/s]
  double torque = -40;         // of the charge on all walls together, mean over a revolution [N m]
  double power = 100;          // -torque * angular_speed [W]
};

/// What went into the hopper's series.
struct HopperTruth {
  double opening_time = 1;  // [s]
  double rate = 2;          // [kg/s] from the opening on
  double body_mass = 0.05;  // [kg]
};

dem_gpu::RunGeometry mill_geometry();
dem_gpu::Snapshot mill_snapshot(const dem_gpu::RunGeometry& geometry, double time);
dem_gpu::RunGeometry hopper_geometry();
dem_gpu::Snapshot hopper_snapshot(const dem_gpu::RunGeometry& geometry, double time);

MillTruth write_mill_run(const std::filesystem::path& folder);
HopperTruth write_hopper_run(const std::filesystem::path& folder);

}  // namespace test_support
