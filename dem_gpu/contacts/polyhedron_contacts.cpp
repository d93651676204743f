// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/contacts/contact_lanes.h"
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/polyhedron_geometry.h"

namespace dem_gpu {
namespace {

/// Contacts of polyhedra with polyhedra: found one after the other, answered side by side.
template <class Law, class Friction, class Record>
struct ComputePolyhedronPairs {
  using Geometry = PolyhedronGeometry<Law, BodyPartner>;
  using Damping = typename Geometry::Damping;
  using Patch = typename Friction::Patch;
  ContactScene scene;
  Geometry geometry;
  Friction friction;

  TALUS_HD void operator()(int begin, int end) const {
    ContactLanes<Patch> touching;
    for (int c = begin; c < end; ++c) {
      find(c, touching);
      if (touching.is_full()) respond_to_all<Damping, Friction, Record>(scene, friction, touching);
    }
    if (touching.count > 0) respond_to_all<Damping, Friction, Record>(scene, friction, touching);
  }

 private:
  TALUS_HD void find(int c, ContactLanes<Patch>& touching) const {
    const ContactKey key = scene.contacts.key[c];
    const int a = key_body_a(key), b = key_body_b(key);
    if (geometry.waits(scene, c, a, b)) return;
    ElasticContact elastic;
    Patch patch;
    if (find_contact(geometry, scene, c, a, b, elastic, patch))
      touching.append(c, a, b, elastic, patch);
    else if (scene.contacts.depth[c] != 0)
      end_contact<Damping, Friction, Record>(scene.contacts, c, body_side(scene.bodies, a), body_side(scene.bodies, b),
                                             scene.step.length, false);
  }
};

template <class Law, class Friction, class Record>
class PolyhedronPairsPass : public Pass {
 public:
  PolyhedronPairsPass(const Law& law, const Friction& friction) : law_(law), friction_(friction) {}

  std::string name() const override { return "polyhedron_contacts"; }
  void launch(const Model& model, State& state, const Gate& gate) override {
    const ContactRange range = state.range[static_cast<int>(ContactKind::polyhedron_polyhedron)];
    parallel_for_ranges<kShortRange>(
        range.first, range.last,
        ComputePolyhedronPairs<Law, Friction, Record>{contact_scene(model, state), {law_}, friction_}, gate);
  }

 private:
  Law law_;
  Friction friction_;
};

}  // namespace

std::unique_ptr<Pass> make_polyhedron_contacts_pass(const Scene& scene) {
  const auto make = [](const auto& law, auto friction, auto record) -> std::unique_ptr<Pass> {
    return std::make_unique<PolyhedronPairsPass<std::decay_t<decltype(law)>, decltype(friction), decltype(record)>>(
        law, friction);
  };
  return std::visit(make, scene.polyhedral_law, polyhedron_friction(scene), record_policy(scene));
}

}  // namespace dem_gpu
