// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/sphere_geometry.h"
#include "dem_gpu/contacts/sphere_pairs.h"
#include "dem_gpu/contacts/welded_surface.h"
#include "dem_gpu/core/lanes.h"

namespace dem_gpu {
namespace {

/// Candidate pairs of a range that touch, in their order; room for one more block of pairs to look at.
struct TouchingPairs {
  int contact[kRangeLength + kRealLanes], a[kRangeLength + kRealLanes], b[kRangeLength + kRealLanes];
  int count = 0;

  /// The pairs from `first` on.
  TALUS_HD PairRows rows(int first) const {
    return {RowLanes::load(contact + first), RowLanes::load(a + first), RowLanes::load(b + first)};
  }
  TALUS_HD void append(const PairRows& rows, unsigned which) {
    append_lanes(rows.contact, which, contact + count);
    append_lanes(rows.a, which, a + count);
    append_lanes(rows.b, which, b + count);
    count += count_bits(which);
  }
  /// Fills the last block with its last pair, which changes nothing.
  TALUS_HD void fill_last_block() {
    for (int i = count; count > 0 && i % kRealLanes != 0; ++i) {
      contact[i] = contact[count - 1];
      a[i] = a[count - 1];
      b[i] = b[count - 1];
    }
  }
};

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
    for (int first = 0; first < touching.count; first += kRealLanes) {
      const PairRows rows = touching.rows(first);
      SphereTouch touch;
      SphereResponse response;
      respond_to_touch<Law, Friction>(law, scene, spheres, rows, touch, response);
      if constexpr (Record::kEnabled)
        for (int i = 0; i < kRealLanes && first + i < touching.count; ++i) record(rows, i, touch, response);
      write_spheres<Friction>(scene, rows, touch, response);
      peaks.take(touch, response);
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
    for (int i = 0; i < kRealLanes; ++i) TALUS_PREFETCH(scene.contacts.row + first + kRealLanes + i);
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
    ElasticContact elastic;
    elastic.normal = lane(touch.normal, i);
    elastic.force = -lane(response.push, i) * elastic.normal;
    elastic.point = scene.bodies.position[a] + lane(touch.lever_a, i) * elastic.normal;
    elastic.energy = lane(response.energy, i);
    ContactForces forces;
    const PairProperties& pair = scene.pair(scene.bodies.material[a], scene.bodies.material[b]);
    forces.normal.is_orbit = scene.step.length > 0 && pair.sphere_damping != 0;
    if constexpr (Friction::kEnabled) forces.friction.force = lane(response.friction, i);
    if constexpr (Friction::kEnabled) forces.friction.energy = lane(response.tangential_energy, i);
    if constexpr (Friction::kHasCouple) forces.friction.couple = lane(response.couple, i);
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
  void run(const Model& model, State& state) override {
    const ContactRange range = state.range[static_cast<int>(ContactKind::sphere_sphere)];
    if (range.first == range.last) return;
    const ContactScene scene = contact_scene(model, state);
    spheres_.resize(static_cast<std::size_t>(scene.bodies.count));
    parallel_for(0, scene.bodies.count, FillSphereRow{scene.bodies, pointer(spheres_)});
    parallel_for_ranges(range.first, range.last,
                        ComputeSpherePairs<Law, Friction, Record>{scene, law_, pointer(spheres_)});
  }

 private:
  Law law_;
  DeviceVector<SphereRow> spheres_;
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
