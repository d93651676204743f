// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/core/prefetch.h"
#include "dem_gpu/core/row_quads.h"
#include "dem_gpu/motion/motion_passes.h"

namespace dem_gpu {
namespace {

/// Sums each body's contacts in ascending order of contact: no atomics, the same sum for any number of threads.
struct GatherForces {
  BodyView bodies;
  ContactView contacts;
  const int* incident_first;
  const std::int64_t* incident;
  int incident_count;
  Vec3 gravity;    // [m/s2]
  Real time_step;  // [s]

  static constexpr int kAhead = 16;  // contacts of bodies to come

  TALUS_HD void prefetch(int k) const {
    const std::int64_t contact = (incident[k < incident_count ? k : 0] & 0xffffffff) >> 1;
    prefetch_to_read(contacts.row + contact);
    prefetch_to_read(contacts.torques + contact);
  }

  TALUS_HD void operator()(int i) const {
    if (!bodies.is_moving(i)) return;
    QuadSum force_sum(bodies.mass[i] * gravity), torque_sum(Vec3{});
    int touching = 0;
    for (int k = incident_first[i]; k < incident_first[i + 1]; ++k) {
      prefetch(k + kAhead);
      const int entry = static_cast<int>(incident[k] & 0xffffffff);
      const int contact = entry >> 1, side = entry & 1;
      const ContactRow& row = contacts.row[contact];
      touching += row.depth != 0 ? 1 : 0;
      force_sum.add(reinterpret_cast<const Real*>(&row), Real(1 - 2 * side));
      torque_sum.add(reinterpret_cast<const Real*>(contacts.torques + contact) + 4 * side, Real(1));
    }
    const Vec3 force = force_sum.vector(), torque = torque_sum.vector();
    bodies.contact_share[i] = Real(1) / (touching > 1 ? touching : 1);
    force_sum.store(bodies.force[i]);
    torque_sum.store(bodies.torque[i]);
    const Real half = time_step / 2;
    bodies.velocity[i] += (half * bodies.inverse_mass[i]) * force;
    const Vec3 kick = half * rotate_back(bodies.orientation[i], torque), inertia = bodies.inertia[i];
    bodies.angular_velocity[i] += Vec3{kick.x / inertia.x, kick.y / inertia.y, kick.z / inertia.z};
  }
};

class GatherForcesPass : public Pass {
 public:
  std::string name() const override { return "gather_forces"; }
  void launch(const Model& model, State& state, const Gate& gate) override {
    const BodyView bodies = view(model.bodies, state.bodies);
    parallel_for(0, bodies.count,
                 GatherForces{bodies, view(state.contacts), pointer(state.incident_first), pointer(state.incident),
                              static_cast<int>(state.incident.size()), model.scene.gravity, model.time_step},
                 gate);
  }
};

}  // namespace

std::unique_ptr<Pass> make_gather_forces_pass() { return std::make_unique<GatherForcesPass>(); }

}  // namespace dem_gpu
