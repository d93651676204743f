// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/sphere_geometry.h"
#include "dem_gpu/contacts/sphere_pairs.h"
#include "dem_gpu/contacts/touching_pairs.h"
#include "dem_gpu/core/prefetch.h"

namespace dem_gpu {
namespace {

/// Bit i: the spheres of pair i touch.
TALUS_HD TALUS_ALL_INLINED inline unsigned touching_bits(const SphereRow* spheres, const PairRows& rows) {
  const Quad<RealLanes> a = gather_quad(spheres, rows.a, 0), b = gather_quad(spheres, rows.b, 0);
  const RealLanes reach = a.number + b.number;
  return bits_of(norm_squared(b.vector - a.vector) < reach * reach);
}

/// Contacts of spheres with spheres: those of a range that touch are found first, then answered side by side.
template <class Law, class Friction, class Record>
struct ComputeSpherePairs {
  using Damping = OrbitDamping<Law>;
  ContactScene scene;
  Law law;
  const SphereRow* spheres;

  TALUS_HD void operator()(int begin, int end) const {
    TouchingPairs touching;
    for (int c = begin; c < end; c += kRealLanes)
      find_touching(c, end - c < kRealLanes ? end - c : kRealLanes, touching);
    if (touching.count == 0) return;
    touching.fill_last_block();
    PeakLanes peaks;
    SphereTouch touch;
    SphereResponse response;
    for (int first = 0; first < touching.count; first += kRealLanes) {
      const PairRows rows = touching.rows(first);
      respond_to_touch<Law, Friction>(law, scene, spheres, rows, touch, response);
      if constexpr (Record::kEnabled)
        for (int i = 0; i < kRealLanes && first + i < touching.count; ++i) record(rows, i, touch, response);
      write_spheres<Friction>(scene, rows, touch, response);
      peaks.take(rows, touch, response);
    }
    peaks.keep(scene.contacts, begin);
  }

 private:
  /// Of `count` candidates from `first` on; the last one again where there are no more.
  TALUS_HD PairRows candidates(int first, int count) const {
    PairRows rows;
    for (int i = 0; i < kRealLanes; ++i) {
      const int c = first + (i < count ? i : count - 1);
      const ContactKey key = scene.contacts.key[c];
      rows.contact.row[i] = c;
      rows.a.row[i] = key_body_a(key);
      rows.b.row[i] = key_body_b(key);
    }
    return rows;
  }
  TALUS_HD void find_touching(int first, int count, TouchingPairs& touching) const {
    const PairRows rows = candidates(first, count);
    for (int i = 0; i < count; ++i) prefetch_to_write(scene.contacts.row + first + i);
    const unsigned here = (1u << count) - 1, touches = touching_bits(spheres, rows) & here;
    touching.append(rows, touches);
    for (unsigned apart = here & ~touches; apart != 0; apart &= apart - 1) {
      const int i = lowest_bit(apart);
      if (scene.contacts.depth[rows.contact[i]] != 0) end(rows.contact[i], rows.a[i], rows.b[i]);
    }
  }

  TALUS_HD void end(int c, int a, int b) const {
    const PairProperties& pair = scene.pair(scene.bodies.material[a], scene.bodies.material[b]);
    end_contact<Damping, Friction, Record>(scene.contacts, c, body_side(scene.bodies, a), body_side(scene.bodies, b),
                                           scene.step.length, pair.sphere_damping > 0);
  }

  TALUS_HD void record(const PairRows& rows, int i, const SphereTouch& touch, const SphereResponse& response) const {
    const int a = rows.a[i], b = rows.b[i];
    const PairProperties& pair = scene.pair(scene.bodies.material[a], scene.bodies.material[b]);
    ElasticContact elastic;
    ContactForces forces;
    lane_of<Friction>(i, touch, response, scene.bodies.position[a], elastic, forces);
    forces.normal.is_orbit = scene.step.length > 0 && pair.sphere_damping != 0;
    record_contact<Damping, Friction>(scene.contacts, rows.contact[i], elastic, forces, body_side(scene.bodies, a),
                                      body_side(scene.bodies, b), scene.step.length);
    scene.contacts.point[rows.contact[i]] = elastic.point;
  }
};

template <class Law, class Friction, class Record>
class SpherePairsPass : public Pass {
 public:
  explicit SpherePairsPass(const Law& law) : law_(law) {}

  std::string name() const override { return "sphere_contacts"; }
  void launch(const Model& model, State& state, const Gate& gate) override {
    const ContactRange range = state.range[static_cast<int>(ContactKind::sphere_sphere)];
    if (range.first == range.last) return;
    const ContactScene scene = contact_scene(model, state);
    spheres_.resize(static_cast<std::size_t>(scene.bodies.count));
    parallel_for(0, scene.bodies.count, FillSphereRow{scene.bodies, pointer(spheres_)}, gate);
    parallel_for_ranges(range.first, range.last,
                        ComputeSpherePairs<Law, Friction, Record>{scene, law_, pointer(spheres_)}, gate);
  }

 private:
  Law law_;
  DeviceVector<SphereRow> spheres_;
};

}  // namespace

std::unique_ptr<Pass> make_sphere_contacts_pass(const Scene& scene) {
  const auto make = [&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    const auto make_policies = [&](auto friction, auto record) -> std::unique_ptr<Pass> {
      return std::make_unique<SpherePairsPass<Law, decltype(friction), decltype(record)>>(law);
    };
    return std::visit(make_policies, sphere_friction<Law>(scene), record_policy(scene));
  };
  return std::visit(make, sphere_law(scene));
}

}  // namespace dem_gpu
