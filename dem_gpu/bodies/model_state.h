// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem_gpu/bodies/body_columns.h"
#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/friction/friction_contact.h"
#include "dem_gpu/meshes/mesh_columns.h"
#include "dem_gpu/periodic/ghost_columns.h"
#include "dem_gpu/scene.h"
#include "dem_gpu/shapes/shape_columns.h"
#include "dem_gpu/simulation.h"
#include "dem_gpu/walls/wall_columns.h"

namespace dem_gpu {

/// The shapes of a scene as the engine uses them.
struct PreparedShapes {
  ShapeColumns columns;           // the scene's shapes, then one per volume object
  std::vector<Real> least_width;  // n_shapes, see shapes/least_width.h [m]
  int first_object = 0;           // row of the first volume object among the walls
};

/// What a run is about: constant once made.
struct Model {
  Scene scene;
  PreparedShapes shapes;
  MeshColumns meshes;  // one per mesh wall
  BodyConstants bodies;
  DeviceVector<PairProperties> pairs;  // n_materials x n_materials
  int material_count = 0;
  std::vector<char> body_is_sphere;  // n_bodies
  ContactFeatures features;
  Real time_step = 0;                // [s]
  Real mean_diameter = 0;            // of the bodies [m]
  std::vector<std::string> classes;  // contact classes of the ledger
  std::vector<int> wall_class;       // n_walls, index into classes; class 0 is particle-particle
};

/// Range of the contact table that holds one kind.
struct ContactRange {
  int first = 0, last = 0;
};

/// Accounts kept on the host: contact columns are emptied into them when the neighbour list changes or someone asks.
struct Accounts {
  std::vector<double> loss_normal, loss_shear;           // per class [J]
  std::vector<double> wall_work;                         // per wall, since time 0 [J]
  std::vector<double> wall_work_taken;                   // per wall, of wall_work when loads were last taken [J]
  std::vector<Vec3> wall_impulse, wall_angular_impulse;  // per wall, since last taken [N s], [N m s]
  double wall_load_time = 0;                             // since last taken [s]
  double initial_kinetic = 0;                            // [J]
  double initial_elastic = 0;                            // of contacts that overlap at time 0 [J]
  double initial_gravitational = 0;                      // [J]
  double removed_energy = 0;                             // all that left with removed bodies [J]
  double removed_gravitational = 0;                      // its gravitational part [J]
  double largest_throughput = 0;                         // of the ledger, at the times bodies were listed anew [J]
  double largest_overlap = 0;                            // [-]
  double largest_rate = 0;                               // stiffness / effective mass [1/s2]
  std::int64_t list_rebuilds = 0;
};

/// What changes from step to step.
struct State {
  std::int64_t step = 0;
  BodyColumns bodies;
  ContactColumns contacts;
  ContactRange range[kContactKinds];
  // Contacts of each body: entry = contact * 2 + side, ascending; body i has [first[i], first[i + 1]).
  DeviceVector<int> incident_first;     // n_bodies + 1
  DeviceVector<std::int64_t> incident;  // (body << 32) | entry
  WallSet walls;
  Real skin = 0;         // of the neighbour list: added to the reach of the search [m]
  Real listed_time = 0;  // of the neighbour list [s]
  bool list_is_stale = true;
  Accounts accounts;
  GhostColumns ghosts;
  DeviceVector<int> list_is_worn = DeviceVector<int>(1, 0);  // raised by the kernel that moves the bodies
  std::int64_t columns_version = 0;  // counts the times that columns have come to lie elsewhere or changed in length

  Real time(const Model& model) const { return static_cast<Real>(step) * model.time_step; }
};

/// The accounts with the contact columns' running sums added.
Accounts accounts_so_far(const Model& model, const State& state);
/// Empties those sums into the accounts.
void collect_accounts(const Model& model, State& state);

}  // namespace dem_gpu
