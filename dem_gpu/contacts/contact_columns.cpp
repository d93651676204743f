// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_columns.h"

namespace dem_gpu {
namespace {

template <class T>
void reset(DeviceVector<T>& column, int count) {
  column.assign(static_cast<std::size_t>(count), T{});
}

}  // namespace

ContactView view(ContactColumns& c) {
  return {pointer(c.key),
          pointer(c.row),
          pointer(c.torques),
          {pointer(c.row)},
          {pointer(c.row)},
          {pointer(c.row)},
          {pointer(c.row)},
          {pointer(c.torques)},
          {pointer(c.torques)},
          pointer(c.point),
          pointer(c.peak_overlap),
          pointer(c.peak_rate),
          pointer(c.is_truncated),
          pointer(c.cache_begin),
          pointer(c.separating),
          pointer(c.apart_until),
          pointer(c.facet_begin),
          pointer(c.facet),
          pointer(c.turning_displacement),
          pointer(c.spring_normal),
          pointer(c.elastic_work),
          pointer(c.orbit_loss),
          pointer(c.tangential_energy),
          pointer(c.loss_normal),
          pointer(c.loss_shear),
          pointer(c.wall_work),
          pointer(c.last_elastic_force),
          pointer(c.last_elastic_torque_a),
          pointer(c.last_elastic_torque_b),
          pointer(c.last_damping_force),
          pointer(c.last_friction_force),
          pointer(c.last_friction_couple),
          pointer(c.wall_impulse),
          pointer(c.wall_angular_impulse)};
}

void resize_columns(ContactColumns& columns, int count, const ContactFeatures& features) {
  reset(columns.row, count);
  reset(columns.torques, count);
  reset(columns.point, count);
  reset(columns.peak_overlap, count);
  reset(columns.peak_rate, count);
  reset(columns.is_truncated, count);
  reset(columns.cache_begin, features.has_polyhedra ? count + 1 : 0);
  reset(columns.facet_begin, features.has_meshes ? count + 1 : 0);
  reset(columns.apart_until, features.has_waiting_pairs ? count : 0);
  reset(columns.turning_displacement, features.has_friction_couples ? count : 0);
  reset(columns.spring_normal, features.has_friction && features.has_polyhedra ? count : 0);
  const int ledger = features.has_ledger ? count : 0;
  for (DeviceVector<Real>* column : {&columns.elastic_work, &columns.tangential_energy, &columns.loss_normal,
                                     &columns.loss_shear, &columns.wall_work})
    reset(*column, ledger);
  for (DeviceVector<Vec3>* column :
       {&columns.last_elastic_force, &columns.last_elastic_torque_a, &columns.last_elastic_torque_b,
        &columns.last_damping_force, &columns.last_friction_force})
    reset(*column, ledger);
  reset(columns.orbit_loss, features.has_spheres ? ledger : 0);
  reset(columns.last_friction_couple, features.has_friction_couples ? ledger : 0);
  reset(columns.wall_impulse, features.has_walls ? count : 0);
  reset(columns.wall_angular_impulse, features.has_walls ? count : 0);
}

}  // namespace dem_gpu
