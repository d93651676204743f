// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tests/benchmark/scenes/speed_scenes.h"

namespace benchmark_scenes {

// What the scenes are put together from.

inline constexpr double kDensity = 2500;  // [kg/m3]

/// One material of that restitution and friction 0.5.
dem_gpu::Scene empty_scene(const std::string& name, double restitution, const SceneOptions& options);

void add_wall(dem_gpu::Scene& scene, const std::string& name, decltype(dem_gpu::Wall::geometry) geometry,
              const dem_gpu::Motion& motion = {});

/// Four planes about 0 .. width in x and y, and a floor at z = 0.
void add_sides(dem_gpu::Scene& scene, double width);
void add_floor(dem_gpu::Scene& scene);

/// A shell along y with end plates, its middle at the origin.
struct Drum {
  double radius, length;  // [m]
  double speed;           // about y [rad/s]
  bool ends_turn = true;  // with the shell
};
dem_gpu::Motion turning(const Drum& drum);
void add_drum(dem_gpu::Scene& scene, const Drum& drum);

struct Lifters {
  int count;
  double height, width;  // [m]
};
/// Blocks on the shell, standing in it by their height once more.
void add_lifters(dem_gpu::Scene& scene, const Drum& drum, const Lifters& lifters);

/// Law, stiffness and time step of the polyhedra; the last thing to be set. `flat_overlap`: at `speed` [m/s].
void set_polyhedral_law(dem_gpu::Scene& scene, const SceneOptions& options, double speed, double flat_overlap);

/// Size of a scene of `bodies` over the same scene of `own`, where its width or all of it grows: their ratio to the
/// power 1 / dimensions.
double growth(int bodies, int own, int dimensions);

}  // namespace benchmark_scenes
