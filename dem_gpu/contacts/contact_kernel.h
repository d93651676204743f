// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/contacts/contact_response.h"
#include "dem_gpu/contacts/contact_scene.h"
#include "dem_gpu/contacts/friction/no_friction.h"
#include "dem_gpu/contacts/friction/patch_friction.h"
#include "dem_gpu/contacts/friction/tangential_spring.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/core/pass.h"
#include "dem_gpu/periodic/ghosts.h"

namespace dem_gpu {

inline ContactScene contact_scene(const Model& model, State& state) {
  return {view(state.contacts),
          bodies_with_ghosts(model, state),
          view(model.shapes.columns),
          view(model.meshes),
          state.walls.device(),
          state.walls.welds(),
          pointer(model.pairs),
          model.material_count,
          {model.time_step, state.step == 1}};
}

/// Not part of the kernel, so that the contact is the same with a record and without.
template <class Geometry, class Patch>
TALUS_HD TALUS_ONE_COPY bool find_contact(const Geometry& geometry, const ContactScene& scene, int c, int a, int b,
                                          ElasticContact& elastic, Patch& patch) {
  return geometry.find(scene, c, a, b, elastic, patch);
}

/// One contact a thread: `Geometry` finds the elastic contact, the response completes it.
template <class Geometry, class Friction, class Record>
struct ComputeContact {
  ContactScene scene;
  Geometry geometry;
  Friction friction;

  TALUS_HD void operator()(int c) const {
    const ContactKey key = scene.contacts.key[c];
    const int a = key_body_a(key), b = key_body_b(key);
    ElasticContact elastic;
    typename Friction::Patch patch;
    const bool is_touching = find_contact(geometry, scene, c, a, b, elastic, patch);
    if (!is_touching && scene.contacts.depth[c] == 0) return;
    const ContactSide side_a = body_side(scene.bodies, a);
    const ContactSide side_b = other_side(b);
    const PairProperties& pair = scene.pair(scene.bodies.material[a], other_material(b));
    if (is_touching)
      respond<typename Geometry::Damping, Friction, Record>(scene.contacts, c, elastic, side_a, side_b, pair, friction,
                                                            patch, scene.step, smaller_diameter(a, b));
    else
      end_contact<typename Geometry::Damping, Friction, Record>(scene.contacts, c, side_a, side_b, scene.step.length,
                                                                pair.sphere_damping > 0);
  }

  TALUS_HD int other_material(int b) const {
    if constexpr (Geometry::Partner::kIsWall)
      return scene.walls[b].material;
    else
      return scene.bodies.material[b];
  }
  TALUS_HD Real smaller_diameter(int a, int b) const {
    if constexpr (Geometry::Partner::kIsWall)
      return scene.bodies.diameter[a];
    else
      return std::min(scene.bodies.diameter[a], scene.bodies.diameter[b]);
  }

  TALUS_HD ContactSide other_side(int b) const {
    if constexpr (Geometry::Partner::kIsWall)
      return wall_side(scene.walls[b]);
    else
      return body_side(scene.bodies, b);
  }
};

template <class Geometry, class Friction, class Record>
class ContactPass : public Pass {
 public:
  ContactPass(std::string name, ContactKind kind, Geometry geometry, Friction friction)
      : name_(std::move(name)), kind_(kind), geometry_(geometry), friction_(friction) {}

  std::string name() const override { return name_; }
  void launch(const Model& model, State& state, const Gate& gate) override {
    const ContactRange range = state.range[static_cast<int>(kind_)];
    parallel_for(range.first, range.last,
                 ComputeContact<Geometry, Friction, Record>{contact_scene(model, state), geometry_, friction_}, gate);
  }

 private:
  std::string name_;
  ContactKind kind_;
  Geometry geometry_;
  Friction friction_;
};

using RecordPolicy = std::variant<NoWorkRecord, WorkRecord>;

/// Friction of contacts between polyhedra, and with walls.
inline std::variant<NoFriction, PatchFriction> polyhedron_friction(const Scene& scene) {
  if (!scene.friction) return NoFriction{};
  return PatchFriction{scene.friction->tangential_stiffness_ratio};
}
inline RecordPolicy record_policy(const Scene& scene) {
  if (!scene.energy_ledger) return NoWorkRecord{};
  return WorkRecord{};
}

/// The choice of kernel, made once: scene, law and friction hold the alternatives. `make_geometry(law)` gives the
/// contact geometry for each alternative of `law`.
template <class Law, class Friction, class MakeGeometry>
std::unique_ptr<Pass> make_contact_pass(std::string name, ContactKind kind, const Scene& scene, const Law& law,
                                        const Friction& friction_policy, const MakeGeometry& make_geometry) {
  const auto make = [&](const auto& chosen, auto friction, auto record) -> std::unique_ptr<Pass> {
    const auto geometry = make_geometry(chosen);
    return std::make_unique<ContactPass<std::decay_t<decltype(geometry)>, decltype(friction), decltype(record)>>(
        std::move(name), kind, geometry, friction);
  };
  return std::visit(make, law, friction_policy, record_policy(scene));
}

}  // namespace dem_gpu
