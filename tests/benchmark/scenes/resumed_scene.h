// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/scene.h"
#include "dem_gpu/snapshot.h"

namespace benchmark_scenes {

/// The scene with its bodies as they are in the snapshot of a run of it, at time 0: another law or time step goes on
/// from there. Bodies that left are left out; gates open that much earlier. Contacts forget their friction, and walls
/// stand as at the start, so the snapshot should be of a time at which a drum looks as it did.
/// Throws catalog::InputError if the snapshot has another number of bodies.
dem_gpu::Scene resumed(dem_gpu::Scene scene, const dem_gpu::Snapshot& snapshot);

}  // namespace benchmark_scenes
