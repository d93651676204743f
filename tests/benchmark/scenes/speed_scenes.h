// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "dem_gpu/scene.h"

namespace benchmark_scenes {

// The scenes that speed is measured on, S1 to S5 of docs/performance.md. All are made here, from no file, and are the
// same on every machine. Bodies begin apart, on a jittered lattice above the floor.

enum class Law { depth_potential, overlap_volume };

struct SceneOptions {
  int bodies = 0;                  // 0: as many as the scene has by itself; boxes widen, drums and hoppers grow
  Law law = Law::depth_potential;  // of polyhedra
  double flat_overlap = 0;         // see stiffness below, share of the diameter [-]; 0: the scene's own
  double steps_per_contact = 20;   // of polyhedra, in the stiffest contact [-]
  bool has_ledger = false;         // no peer keeps one
};

// Stiffness of polyhedra: the heaviest body, landing flat at the speed that bodies fall on each other with while the
// scene fills, sinks in by `flat_overlap` of its diameter; an edge sinks in some 5 times as far, a corner 13 times,
// less what it gives way by turning. Both laws have the same stiffness of a flat contact, and so the same time step.

/// S1: spheres of 10 mm in a box of 0.2 x 0.2 m; 10,000 by themselves.
dem_gpu::Scene sphere_box(const SceneOptions& options);
/// S1: the same spheres in a drum of radius 0.15 and length 0.3 m at 30 rpm; its ends stand still, as LIGGGHTS and
/// LAMMPS have them.
dem_gpu::Scene sphere_drum(const SceneOptions& options);
/// S2: cubes of 10 mm and truncated tetrahedra of 1 cm3, half each, in a box of 0.12 x 0.12 m; 1,000 by themselves.
dem_gpu::Scene mixed_box(const SceneOptions& options);
/// S3: Ls of 3 cubes of 8 mm and crosses of 4 parts, 24 x 24 x 8 mm, half each, in a box of 0.16 x 0.16 m, whose floor
/// opens over 80 x 80 mm at kOutletOpens; 500 by themselves.
dem_gpu::Scene outlet_box(const SceneOptions& options);
inline constexpr double kOutletOpens = 1.5;  // [s]
/// S4: cubes of 10 mm in a mill of radius 0.15 and length 0.14 m with 8 lifters of 15 x 15 mm at 5.661 rad/s; 1,500 by
/// themselves.
dem_gpu::Scene cube_mill(const SceneOptions& options);
/// S5: rocks of `parts` parts (4 or 8) in a hopper whose gate opens at kHopperOpens, and in a mill at 70 % of its
/// critical speed; of 10 mm, 1,000 by themselves. Both keep their form whatever the number.
dem_gpu::Scene rock_hopper(const SceneOptions& options, int parts);
dem_gpu::Scene rock_mill(const SceneOptions& options, int parts);
inline constexpr double kHopperOpens = 0.5;  // [s]

/// A scene with the time at which it is timed.
struct SpeedScene {
  std::string name;
  dem_gpu::Scene (*make)(const SceneOptions&);
  bool has_polyhedra;
  double busy_time;      // of the hardest impacts [s]
  double settling_time;  // before the first window; in S4 whole lifter passages, so that it looks as it did [s]
};
/// Windows follow the settling one after the other.
inline constexpr double kWindow = 0.1;  // [s]
inline constexpr int kWindows = 3;

/// "s1-box", "s1-drum", "s2", "s3", "s4" and, of S5, "hopper-4", "hopper-8", "mill-4", "mill-8".
const std::vector<SpeedScene>& speed_scenes();

/// Throws catalog::UsageError with a suggestion for an unknown name.
const SpeedScene& speed_scene(const std::string& name);

}  // namespace benchmark_scenes
