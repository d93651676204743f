// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/welded_surface.h"

namespace dem_gpu {
namespace {

// A sphere that crosses the seam of two welded walls takes along what its contact carries: springs, work, the state of
// its damping. Contact c takes them over from a contact of the same sphere that c's wall holds from now on. First each
// contact finds the one it takes over, then all are taken over: no thread reads what another writes.

struct FindCrossings {
  ContactScene scene;
  int contact_count, first;
  int* left;  // the contact that contact first + i takes over, -1 for none

  TALUS_HD void operator()(int c) const { left[c - first] = taken_over_by(c); }

  TALUS_HD int taken_over_by(int c) const {
    const ContactView& contacts = scene.contacts;
    if (contacts.depth[c] != 0) return -1;
    const int sphere = key_body_a(contacts.key[c]), wall = key_body_b(contacts.key[c]);
    const WallRecord& record = scene.walls[wall];
    for (int k = 0; k < record.weld_count; ++k) {
      const int other = contact_with(sphere, scene.welds[record.first_weld + k]);
      if (other >= 0 && contacts.depth[other] != 0 && takes_over(sphere, wall, key_body_b(contacts.key[other])))
        return other;
    }
    return -1;
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

/// A contact has one holder at most, and takes over only from contacts in touch, not in touch itself: no two threads
/// touch the same one.
struct TakeOver {
  ContactView contacts;
  ContactFeatures features;
  int first;
  const int* left;

  TALUS_HD void operator()(int c) const {
    const int from = left[c - first];
    if (from < 0) return;
    visit_history(features, [&](auto column) {
      auto& carried = (contacts.*column)[from];
      (contacts.*column)[c] = carried;
      carried = {};
    });
  }
};

class SeamCrossingsPass : public Pass {
 public:
  std::string name() const override { return "seam_crossings"; }
  void launch(const Model& model, State& state, const Gate& gate) override {
    const ContactRange walls = state.range[static_cast<int>(ContactKind::sphere_wall)];
    const ContactRange objects = state.range[static_cast<int>(ContactKind::sphere_object)];
    const int first = walls.first, last = objects.last;
    left_.resize(static_cast<std::size_t>(std::max(last - first, 0)));
    parallel_for(
        first, last,
        FindCrossings{contact_scene(model, state), static_cast<int>(state.contacts.key.size()), first, pointer(left_)},
        gate);
    parallel_for(first, last, TakeOver{view(state.contacts), model.features, first, pointer(left_)}, gate);
  }

 private:
  DeviceVector<int> left_;  // between the two kernels alone
};

}  // namespace

std::unique_ptr<Pass> make_seam_crossings_pass() { return std::make_unique<SeamCrossingsPass>(); }

}  // namespace dem_gpu
