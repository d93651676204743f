// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "catalog/convex_part.h"
#include "catalog/triangle_mesh.h"
#include "dem_gpu/core/quaternion.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

// What a run leaves behind for postprocess. Plain host structs; the files are HDF5, written beside and renamed, with
// object times switched off so that equal states give equal bytes.
//
// A run folder holds:
//   resolved_scene.json          the scene as understood, SI
//   geometry.h5                  RunGeometry: shapes and walls
//   snapshots/snapshot_000000.h5 Snapshot series, numbered from 0
//   checkpoint.h5                last checkpoint (engine's own layout), checkpoint_previous.h5 the one before
//   time_series.csv              one row per series interval, headers name[unit] (see simulation.h, SeriesRow)
//   walls.csv                    long form: time[s],wall,force_x[N],force_y[N],force_z[N],torque_x[N m],torque_y[N m],
//                                torque_z[N m],power[W],work[J]   (torque about the wall's rotation centre)
//   groups.csv                   the same columns, summed over the walls that share a motion; only where some do
//   ledger.csv                   long form: time[s],class,dissipation_normal[J],dissipation_shear[J]
//   run.json                     summary written at the end: see RunSummary in simulation.h
//   run.log                      passes, warnings, progress lines
//   lock                         held by the process that runs it

struct ShapeGeometry {
  std::string name;
  double sphere_radius = 0;                // > 0 for a sphere [m]; parts is empty then
  std::vector<catalog::ConvexPart> parts;  // body frame, scale 1 [m]
  double volume = 0;                       // at scale 1 [m3]
};

enum class WallKind : int { plane = 0, disc = 1, cylinder = 2, cone = 3, volume_object = 4, mesh = 5, sphere = 6 };

struct WallGeometry {
  std::string name;
  std::string contact_class;
  WallKind kind = WallKind::plane;
  Vec3 point;                    // plane point, disc centre, base of cylinder and cone, at time 0 [m]
  Vec3 direction;                // normal or axis, unit, at time 0
  double length = 0;             // [m] cylinder, cone
  double base_radius = 0;        // [m] disc, cylinder, cone
  double top_radius = 0;         // [m] cone
  catalog::ConvexPart part;      // volume objects, world frame at time 0 [m]
  catalog::TriangleMesh mesh{};  // meshes: the surface that bodies touch, world frame at time 0 [m]
};

struct RunGeometry {
  std::vector<ShapeGeometry> shapes;
  std::vector<std::string> materials;
  std::vector<double> material_density;  // [kg/m3]
  std::vector<int> body_shape;           // n_bodies
  std::vector<int> body_material;        // n_bodies
  std::vector<double> body_scale;        // n_bodies
  std::vector<double> body_mass;         // n_bodies [kg]
  std::vector<WallGeometry> walls;
};

/// One contact that carries force at the snapshot's time.
struct SnapshotContact {
  int body_a = 0;
  int body_b = 0;      // body index, or -1 - wall index
  Vec3 point;          // beside body_a, also where the two meet across a face of a periodic box [m]
  Vec3 force;          // on body a, world frame [N]
  double overlap = 0;  // largest depth [m]
};

struct Snapshot {
  double time = 0;  // [s]
  std::int64_t step = 0;
  std::vector<char> active;               // n_bodies: 0 once removed by the outflow
  std::vector<Vec3> position;             // n_bodies, in the box of a periodic scene [m]
  std::vector<Quaternion> orientation;    // n_bodies, body to world
  std::vector<Vec3> velocity;             // n_bodies [m/s]
  std::vector<Vec3> angular_velocity;     // n_bodies, world frame [rad/s]
  std::vector<Vec3> wall_translation;     // n_walls: x_world(t) = wall_rotation * x_world(0) + wall_translation
  std::vector<Quaternion> wall_rotation;  // n_walls
  std::vector<char> wall_present;         // n_walls: 0 once removed (an open gate)
  std::vector<SnapshotContact> contacts;
};

/// Each throws catalog::InputError for a file that is missing, truncated, or not of this kind or version.
void write_geometry(const std::filesystem::path& file, const RunGeometry& geometry);
RunGeometry read_geometry(const std::filesystem::path& file);
void write_snapshot(const std::filesystem::path& file, const Snapshot& snapshot);
Snapshot read_snapshot(const std::filesystem::path& file);
/// The snapshot's time alone [s], without reading its arrays.
double read_snapshot_time(const std::filesystem::path& file);

/// snapshots/snapshot_000012.h5 of a run folder, ascending; empty if there are none.
std::vector<std::filesystem::path> snapshot_files(const std::filesystem::path& run_folder);

}  // namespace dem_gpu
