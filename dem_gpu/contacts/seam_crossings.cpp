// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/welded_surface.h"

namespace dem_gpu {
namespace {

/// A sphere that crosses the seam of two welded walls takes along what its contact carries: springs, work, the state of
/// its damping. Contact c takes them over from a contact of the same sphere that c's wall holds from now on. A contact
/// has one holder at most, so no two threads touch the same one.
struct CrossSeams {
  ContactScene scene;
  ContactFeatures features;
  int contact_count;

  TALUS_HD void operator()(int c) const {
    const ContactView& contacts = scene.contacts;
    if (contacts.depth[c] != 0) return;
    const int sphere = key_body_a(contacts.key[c]), wall = key_body_b(contacts.key[c]);
    const WallRecord& record = scene.walls[wall];
    for (int k = 0; k < record.weld_count; ++k) {
      const int left = contact_with(sphere, scene.welds[record.first_weld + k]);
      if (left < 0 || contacts.depth[left] == 0 || !takes_over(sphere, wall, key_body_b(contacts.key[left]))) continue;
      visit_history(features, [&](auto column) {
        auto& carried = (contacts.*column)[left];
        (contacts.*column)[c] = carried;
        carried = {};
      });
      return;
    }
  }

  TALUS_HD bool takes_over(int sphere, int wall, int from) const {
    const Vec3 centre = scene.bodies.position[sphere];
    const Real radius = scene.bodies.bounding_radius[sphere];
    return holder_of_contact(scene, from, centre, radius) == wall && holder_of_contact(scene, wall, centre, radius) < 0;
  }

  /// -1: not a candidate pair.
  TALUS_HD int contact_with(int sphere, int wall) const {
    const bool is_object = scene.walls[wall].kind == WallKind::volume_object;
    const ContactKey key = contact_key(is_object ? ContactKind::sphere_object : ContactKind::sphere_wall, sphere, wall);
    const int found = lower_bound(scene.contacts.key, contact_count, key);
    return found < contact_count && scene.contacts.key[found] == key ? found : -1;
  }
};

class SeamCrossingsPass : public Pass {
 public:
  std::string name() const override { return "seam_crossings"; }
  void run(const Model& model, State& state) override {
    const ContactRange walls = state.range[static_cast<int>(ContactKind::sphere_wall)];
    const ContactRange objects = state.range[static_cast<int>(ContactKind::sphere_object)];
    parallel_for(walls.first, objects.last,
                 CrossSeams{contact_scene(model, state), model.features, static_cast<int>(state.contacts.key.size())});
  }
};

}  // namespace

std::unique_ptr<Pass> make_seam_crossings_pass() { return std::make_unique<SeamCrossingsPass>(); }

}  // namespace dem_gpu
