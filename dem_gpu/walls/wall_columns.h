// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "dem_gpu/core/device_vector.h"
#include "dem_gpu/core/quaternion.h"
#include "dem_gpu/scene.h"
#include "dem_gpu/snapshot.h"
#include "dem_gpu/walls/wall_motion.h"

namespace dem_gpu {

/// A wall at one instant, world frame. Which fields count depends on the kind.
struct WallRecord {
  WallKind kind = WallKind::plane;
  bool is_present = true;
  int shape = -1;  // volume objects: row of ShapeColumns
  int mesh = -1;   // meshes: row of MeshColumns::meshes
  int material = 0;
  Vec3 point;      // plane point, disc centre, base of cylinder and cone; position of a volume object or mesh [m]
  Vec3 direction;  // normal or axis, unit
  Vec3 side;       // discs: a unit vector in the face at time 0
  bool solid_within = false;           // cylinder, cone, ball: bodies are outside
  Real thickness = 0;                  // discs; 0: all behind is solid [m]
  int rim_neighbour[2] = {-1, -1};     // wall that shares the rim at the base and at the top, -1 for none
  int first_weld = 0, weld_count = 0;  // walls that are one solid with it: a piece of WallSet::welds
  Real length = 0;                     // [m]
  Real base_radius = 0;                // [m]
  Real top_radius = 0;                 // [m]
  Real bounding_radius = 0;            // volume objects, about point [m]
  Quaternion orientation;              // volume objects and meshes
  Vec3 rotation_centre;                // where the wall's torque is taken [m]
  Vec3 velocity;                       // at the end of the step, of the material point at rotation_centre [m/s]
  Vec3 angular_velocity;               // [rad/s]
  Vec3 mean_velocity;                  // over the step, of the same point [m/s]
  Vec3 mean_angular_velocity;          // [rad/s]
};

/// Walls as functions of time: no state of their own, so a resumed run finds them where they were.
class WallSet {
 public:
  /// `first_shape`: row of the first volume object's shape.
  WallSet(const Scene& scene, int first_shape);

  /// `welds`: for each wall, those that are one solid with it.
  void weld(const std::vector<std::vector<int>>& welds);
  /// Moves every wall to `time`; true if one came or went.
  bool move_to(Real time);
  /// How far any wall's surface can have moved between two times, walls that map onto themselves left out [m].
  Real largest_displacement(Real from, Real to) const;
  /// Bound of the same over any time of length `span` [m].
  Real largest_displacement(Real span) const;
  /// The wall that it belongs to.
  int fastest(Real span) const;

  int count() const { return static_cast<int>(now_.size()); }
  const std::vector<WallRecord>& records() const { return now_; }
  const WallRecord* device() const { return pointer(device_); }
  const int* welds() const { return pointer(welds_); }
  Vec3 translation(int wall) const;  // x_world(t) = rotation * x_world(0) + translation
  Quaternion rotation(int wall) const;
  bool has_moving_walls() const;
  /// Does any have a motion? Walls that come or go alone stay where they are.
  bool any_moves() const;
  /// Is any there now that is not at `time`, or the other way round?
  bool comes_or_goes(Real time) const;

 private:
  bool is_present_at(int wall, Real time) const;
  Real displacement(int wall, const WallTravel& gone) const;
  Real bound_of_displacement(int wall, Real span) const;
  /// Finds walls that share a rim and keep sharing it.
  void join_rims();

  std::vector<Wall> walls_;
  std::vector<WallRecord> at_start_;
  std::vector<WallRecord> now_;
  std::vector<Real> turn_reach_;   // of the surface from the axis of rotation [m]; 0: it maps onto itself
  std::vector<Real> swing_reach_;  // from the axis of oscillation [m]
  DeviceVector<WallRecord> device_;
  DeviceVector<int> welds_;  // of all walls end to end
  Real time_ = 0;
};

}  // namespace dem_gpu
