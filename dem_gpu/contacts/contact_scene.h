// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/bodies/body_columns.h"
#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/friction/friction_contact.h"
#include "dem_gpu/contacts/normal_damping.h"
#include "dem_gpu/meshes/mesh_columns.h"
#include "dem_gpu/shapes/shape_columns.h"
#include "dem_gpu/walls/wall_columns.h"

namespace dem_gpu {

/// Everything a contact kernel reads, and the contact table it writes.
struct ContactScene {
  ContactView contacts;
  BodyView bodies;
  ShapeView shapes;
  MeshView meshes;
  const WallRecord* walls;
  const int* welds;
  const PairProperties* pairs;
  int material_count;
  Step step;  // that ends now

  TALUS_HD const PairProperties& pair(int material_a, int material_b) const {
    return pairs[material_a * material_count + material_b];
  }
  TALUS_HD Pose pose(int body) const {
    return {rotation_matrix(bodies.orientation[body]), bodies.position[body], bodies.scale[body]};
  }
};

/// What stands on side b of a contact.
struct BodyPartner {
  static constexpr bool kIsWall = false;
};
struct WallPartner {
  static constexpr bool kIsWall = true;
};

}  // namespace dem_gpu
