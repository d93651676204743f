// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/bodies/body_columns.h"
#include "dem_gpu/core/row_quads.h"

namespace dem_gpu {

/// What contacts of spheres read of a body, side by side: neighbours lie anywhere in memory.
struct SphereRow {
  Vec3 position;  // as in BodyColumns, all of them
  Real radius = 0;
  Vec3 mean_velocity;
  Real inverse_mass = 0;
  Vec3 mean_angular_velocity;
  Real contact_share = 0;
  Vec3 predicted_velocity;
  Real diameter = 0;
  Vec3 predicted_angular_velocity;
  Real none = 0;

  /// Member by member: a row put together elsewhere would be copied in wider pieces than it was written in, for which
  /// processors wait (3 % of the S1 drum's time).
  TALUS_HD void fill(const BodyView& bodies, int i) {
    position = bodies.position[i];
    radius = bodies.bounding_radius[i];
    mean_velocity = bodies.mean_velocity[i];
    inverse_mass = bodies.inverse_mass[i];
    mean_angular_velocity = bodies.mean_angular_velocity[i];
    contact_share = bodies.contact_share[i];
    predicted_velocity = bodies.predicted_velocity[i];
    diameter = bodies.diameter[i];
    predicted_angular_velocity = bodies.predicted_angular_velocity[i];
  }
};

/// Copies the columns of body i into its row.
struct FillSphereRow {
  BodyView bodies;
  SphereRow* rows;

  TALUS_HD void operator()(int i) const { rows[i].fill(bodies, i); }
};

/// Rows of as many spheres as there are lanes.
struct SphereLanes {
  Quad<RealLanes> position_radius, velocity_inverse_mass, spin_share, predicted_velocity_diameter, predicted_spin;

  TALUS_HD static SphereLanes of(const SphereRow* rows, const RowLanes& lanes) {
    return {gather_quad(rows, lanes, 0), gather_quad(rows, lanes, 1), gather_quad(rows, lanes, 2),
            gather_quad(rows, lanes, 3), gather_quad(rows, lanes, 4)};
  }
  TALUS_HD const Vector3<RealLanes>& position() const { return position_radius.vector; }
  TALUS_HD const RealLanes& radius() const { return position_radius.number; }
  TALUS_HD const Vector3<RealLanes>& mean_velocity() const { return velocity_inverse_mass.vector; }
  TALUS_HD const RealLanes& inverse_mass() const { return velocity_inverse_mass.number; }
  TALUS_HD const Vector3<RealLanes>& mean_spin() const { return spin_share.vector; }
  TALUS_HD const RealLanes& contact_share() const { return spin_share.number; }
  TALUS_HD const Vector3<RealLanes>& predicted_velocity() const { return predicted_velocity_diameter.vector; }
  TALUS_HD const RealLanes& diameter() const { return predicted_velocity_diameter.number; }
};

}  // namespace dem_gpu
