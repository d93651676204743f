// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/sphere_geometry.h"
#include "dem_gpu/contacts/sphere_pairs.h"
#include "dem_gpu/contacts/welded_surface.h"

namespace dem_gpu {
namespace {

/// Candidate pairs of a range that touch, in their order.
struct TouchingPairs {
  int contact[kRangeLength], a[kRangeLength], b[kRangeLength];
  int count = 0;

  TALUS_HD void append(int c, int body_a, int body_b) {
    contact[count] = c;
    a[count] = body_a;
    b[count] = body_b;
    ++count;
  }
  /// The next pairs from `first` on; the last one again where there are no more, which changes nothing.
  TALUS_HD PairRows rows(int first) const {
    PairRows rows;
    for (int i = 0; i < kRealLanes; ++i) {
      const int pair = first + i < count ? first + i : count - 1;
      rows.contact.set(i, contact[pair]);
      rows.a.set(i, a[pair]);
      rows.b.set(i, b[pair]);
    }
    return rows;
  }
};

/// Bit i: the spheres of pair i touch.
TALUS_HD TALUS_ALL_INLINED inline unsigned touching_bits(const BodyView& bodies, const PairRows& rows) {
  const RealLanes reach = gather(bodies.bounding_radius, rows.a) + gather(bodies.bounding_radius, rows.b);
  return bits_of(norm_squared(gather(bodies.position, rows.b) - gather(bodies.position, rows.a)) < reach * reach);
}

/// Contacts of spheres with spheres: those of a range that touch are found first, then answered side by side.
template <class Law, class Friction, class Record>
struct ComputeSpherePairs {
  using Damping = OrbitDamping<Law>;
  ContactScene scene;
  Law law;

  TALUS_HD void operator()(int begin, int end) const {
    TouchingPairs touching;
    for (int c = begin; c < end; c += kRealLanes)
      find_touching(c, end - c < kRealLanes ? end - c : kRealLanes, touching);
    for (int first = 0; first < touching.count; first += kRealLanes) {
      const PairRows rows = touching.rows(first);
      SphereTouch touch;
      SphereResponse response;
      respond_to_touch<Law, Friction>(law, scene, rows, touch, response);
      if constexpr (Record::kEnabled)
        for (int i = 0; i < kRealLanes && first + i < touching.count; ++i) record(rows, i, touch, response);
      write_spheres<Friction>(scene, rows, touch, response);
    }
  }

 private:
  TALUS_HD void find_touching(int first, int count, TouchingPairs& touching) const {
    PairRows rows;
    for (int i = 0; i < kRealLanes; ++i) {
      const int c = first + (i < count ? i : count - 1);
      const ContactKey key = scene.contacts.key[c];
      rows.contact.set(i, c);
      rows.a.set(i, key_body_a(key));
      rows.b.set(i, key_body_b(key));
    }
    const unsigned touches = touching_bits(scene.bodies, rows);
    for (int i = 0; i < count; ++i) {
      if ((touches >> i & 1) != 0)
        touching.append(rows.contact[i], rows.a[i], rows.b[i]);
      else if (scene.contacts.depth[rows.contact[i]] != 0)
        end(rows.contact[i], rows.a[i], rows.b[i]);
    }
  }

  TALUS_HD void end(int c, int a, int b) const {
    const PairProperties& pair = scene.pair(scene.bodies.material[a], scene.bodies.material[b]);
    end_contact<Damping, Friction, Record>(scene.contacts, c, body_side(scene.bodies, a), body_side(scene.bodies, b),
                                           scene.step.length, pair.sphere_damping > 0);
  }

  TALUS_HD void record(const PairRows& rows, int i, const SphereTouch& touch, const SphereResponse& response) const {
    const int a = rows.a[i], b = rows.b[i];
    ElasticContact elastic;
    elastic.normal = lane(touch.normal, i);
    elastic.force = -lane(response.push, i) * elastic.normal;
    elastic.point = lane(touch.point, i);
    elastic.energy = lane(response.energy, i);
    ContactForces forces;
    const PairProperties& pair = scene.pair(scene.bodies.material[a], scene.bodies.material[b]);
    forces.normal.is_orbit = scene.step.length > 0 && pair.sphere_damping != 0;
    if constexpr (Friction::kEnabled) forces.friction.force = lane(response.friction, i);
    if constexpr (Friction::kEnabled) forces.friction.energy = lane(response.tangential_energy, i);
    if constexpr (Friction::kHasCouple) forces.friction.couple = lane(response.couple, i);
    record_contact<Damping, Friction>(scene.contacts, rows.contact[i], elastic, forces, body_side(scene.bodies, a),
                                      body_side(scene.bodies, b), scene.step.length);
  }
};

template <class Law, class Friction, class Record>
class SpherePairsPass : public Pass {
 public:
  explicit SpherePairsPass(const Law& law) : law_(law) {}

  std::string name() const override { return "sphere_contacts"; }
  void launch(const Model& model, State& state, const Gate& gate) override {
    const ContactRange range = state.range[static_cast<int>(ContactKind::sphere_sphere)];
    parallel_for_ranges(range.first, range.last,
                        ComputeSpherePairs<Law, Friction, Record>{contact_scene(model, state), law_}, gate);
  }

 private:
  Law law_;
};

template <class Law>
struct SphereWallGeometry {
  using Partner = WallPartner;
  using Damping = OrbitDamping<Law>;
  Law law;

  template <class Patch>
  TALUS_HD bool find(const ContactScene& scene, int /*c*/, int a, int b, ElasticContact& elastic, Patch& patch) const {
    const WallRecord& wall = scene.walls[b];
    const Real radius = scene.bodies.bounding_radius[a];
    const SurfaceDistance surface = surface_distance(wall, scene.bodies.position[a]);
    if (surface.rim >= 0 && is_held_beside(scene, b, scene.bodies.position[a], surface)) return false;
    if (-surface.depth >= radius) return false;
    if (wall.weld_count > 0 && holder_of_contact(scene, b, scene.bodies.position[a], radius) >= 0) return false;
    return sphere_contact(law, scene.bodies.position[a], radius, {-surface.depth, surface.into_wall, radius},
                          scene.pair(scene.bodies.material[a], wall.material), elastic, patch);
  }

  /// Where two walls share a rim, the nearest point on it counts once, and not at all if the other wall comes nearer.
  TALUS_HD static bool is_held_beside(const ContactScene& scene, int wall, const Vec3& x,
                                      const SurfaceDistance& surface) {
    const int other = scene.walls[wall].rim_neighbour[surface.rim];
    if (other < 0 || !scene.walls[other].is_present) return false;
    const SurfaceDistance beside = surface_distance(scene.walls[other], x);
    return beside.rim < 0 || other < wall;
  }
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

std::unique_ptr<Pass> make_sphere_wall_contacts_pass(const Scene& scene) {
  return make_sphere_pass("sphere_wall_contacts", ContactKind::sphere_wall, scene,
                          [](const auto& law) { return SphereWallGeometry<std::decay_t<decltype(law)>>{law}; });
}

}  // namespace dem_gpu
