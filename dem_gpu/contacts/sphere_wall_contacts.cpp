// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/sphere_geometry.h"
#include "dem_gpu/contacts/sphere_pairs.h"
#include "dem_gpu/contacts/touching_pairs.h"
#include "dem_gpu/contacts/welded_surface.h"

namespace dem_gpu {
namespace {

/// Where two walls share a rim, the nearest point on it counts once, and not at all if the other wall comes nearer.
TALUS_HD bool is_held_beside(const ContactScene& scene, int wall, const Vec3& x, const SurfaceDistance& surface) {
  const int other = scene.walls[wall].rim_neighbour[surface.rim];
  if (other < 0 || !scene.walls[other].is_present) return false;
  const SurfaceDistance beside = surface_distance(scene.walls[other], x);
  return beside.rim < 0 || other < wall;
}

/// False if the sphere does not touch the wall, or something beside it holds it.
TALUS_HD bool find_wall(const ContactScene& scene, int a, int b, WallDistance& found) {
  const WallRecord& wall = scene.walls[b];
  const Vec3& x = scene.bodies.position[a];
  const Real radius = scene.bodies.bounding_radius[a];
  const SurfaceDistance surface = surface_distance(wall, x);
  if (surface.rim >= 0 && is_held_beside(scene, b, x, surface)) return false;
  if (-surface.depth >= radius) return false;
  if (wall.weld_count > 0 && holder_of_contact(scene, b, x, radius) >= 0) return false;
  found = {-surface.depth, surface.into_wall};
  return radius - found.distance > 0;
}

/// Walls as the spheres beside them see them.
struct WallLanes {
  Vector3<RealLanes> into_wall;
  RealLanes distance;  // [m]
  // At the contact point.
  Vector3<RealLanes> mean_velocity, predicted_velocity;  // [m/s]
  Vector3<RealLanes> mean_spin, predicted_spin;          // [rad/s]

  TALUS_HD void set(int i, const WallDistance& gap) {
    set_lane(into_wall, i, gap.into_wall);
    lane(distance, i) = gap.distance;
  }
  TALUS_HD void set_motion(int i, const WallRecord& wall, const Vec3& point) {
    const ContactSide side = wall_side(wall);
    set_lane(mean_velocity, i, side.mean_velocity_at(point));
    set_lane(predicted_velocity, i, side.predicted_velocity_at(point));
    set_lane(mean_spin, i, side.mean_angular_velocity);
    set_lane(predicted_spin, i, side.predicted_angular_velocity);
  }

 private:
  TALUS_HD static void set_lane(Vector3<RealLanes>& lanes, int i, const Vec3& v) {
    lane(lanes.x, i) = v.x;
    lane(lanes.y, i) = v.y;
    lane(lanes.z, i) = v.z;
  }
};

/// Not part of a kernel, so that motion is the same with a work record and without.
template <class Law, class Friction>
TALUS_HD TALUS_ONE_COPY TALUS_ALL_INLINED void respond_to_wall(const Law& law, const ContactScene& scene,
                                                               const PairRows& rows, WallLanes& walls,
                                                               SphereTouch& touch, SphereResponse& response) {
  SphereRow spheres[kRealLanes];
  RowLanes here;
  for (int i = 0; i < kRealLanes; ++i) {
    spheres[i].fill(scene.bodies, rows.a[i]);
    here.row[i] = i;
  }
  const SphereLanes a = SphereLanes::of(spheres, here);
  const LastContact last = LastContact::of(scene, rows);
  touch = SphereTouch::of_wall(a, walls.into_wall, walls.distance, last.force_depth.number);
  const Vector3<RealLanes> point = a.position() + touch.lever_a * touch.normal;
  for (int i = 0; i < kRealLanes; ++i) walls.set_motion(i, scene.walls[rows.b[i]], lane(point, i));
  const SphereVelocities mean =
      SphereVelocities::of(a.mean_velocity() - walls.mean_velocity, a.mean_spin(), walls.mean_spin, touch);
  const SphereVelocities predicted = SphereVelocities::of(a.predicted_velocity() - walls.predicted_velocity,
                                                          a.predicted_spin.vector, walls.predicted_spin, touch);
  response.diameter = a.diameter();
  response.contact_share = a.contact_share();
  response.inverse_mass = a.inverse_mass();
  const PairLanes pair = pair_lanes(scene, rows, [&](int i) { return scene.walls[rows.b[i]].material; });
  find_forces<Law, Friction>(law, scene, rows, last, touch, pair, mean, predicted, response);
}

/// Contacts of spheres with walls: those of a range that touch are found first, then answered side by side.
template <class Law, class Friction, class Record>
struct ComputeSphereWalls {
  using Damping = OrbitDamping<Law>;
  ContactScene scene;
  Law law;

  TALUS_HD void operator()(int begin, int end) const {
    TouchingPairs touching;
    WallDistance gap[kRangeLength + kRealLanes];
    for (int c = begin; c < end; ++c) find_touching(c, touching, gap);
    if (touching.count == 0) return;
    touching.fill_last_block();
    PeakLanes peaks;
    SphereTouch touch;
    SphereResponse response;
    for (int first = 0; first < touching.count; first += kRealLanes) {
      const PairRows rows = touching.rows(first);
      const int count = touching.count - first < kRealLanes ? touching.count - first : kRealLanes;
      WallLanes walls;
      for (int i = 0; i < kRealLanes; ++i) walls.set(i, gap[first + (i < count ? i : count - 1)]);
      respond_to_wall<Law, Friction>(law, scene, rows, walls, touch, response);
      if constexpr (Record::kEnabled)
        for (int i = 0; i < count; ++i) record(rows, i, touch, response);
      write_spheres<Friction>(scene, rows, touch, response);
      for (int i = 0; i < count; ++i) write_wall(rows.contact[i], rows.a[i], rows.b[i], i, touch, response);
      peaks.take(rows, touch, response);
    }
    peaks.keep(scene.contacts, begin);
  }

 private:
  TALUS_HD void find_touching(int c, TouchingPairs& touching, WallDistance* gap) const {
    const ContactKey key = scene.contacts.key[c];
    const int a = key_body_a(key), b = key_body_b(key);
    if (find_wall(scene, a, b, gap[touching.count]))
      touching.append(c, a, b);
    else if (scene.contacts.depth[c] != 0)
      end_contact<Damping, Friction, Record>(scene.contacts, c, body_side(scene.bodies, a), wall_side(scene.walls[b]),
                                             scene.step.length, pair(a, b).sphere_damping > 0);
  }

  TALUS_HD const PairProperties& pair(int a, int b) const {
    return scene.pair(scene.bodies.material[a], scene.walls[b].material);
  }

  TALUS_HD void record(const PairRows& rows, int i, const SphereTouch& touch, const SphereResponse& response) const {
    const int a = rows.a[i], b = rows.b[i];
    ElasticContact elastic;
    ContactForces forces;
    lane_of<Friction>(i, touch, response, scene.bodies.position[a], elastic, forces);
    forces.normal.is_orbit = scene.step.length > 0 && pair(a, b).sphere_damping != 0;
    record_contact<Damping, Friction>(scene.contacts, rows.contact[i], elastic, forces, body_side(scene.bodies, a),
                                      wall_side(scene.walls[b]), scene.step.length);
  }

  /// What acts on the wall, about its rotation centre.
  TALUS_HD TALUS_ONE_COPY void write_wall(int c, int a, int b, int i, const SphereTouch& touch,
                                          const SphereResponse& response) const {
    const ContactView& contacts = scene.contacts;
    const Vec3 force = contacts.force[c];
    const Vec3 point = scene.bodies.position[a] + lane(touch.lever_a, i) * lane(touch.normal, i);
    Vec3 torque = -cross(point - scene.walls[b].rotation_centre, force);
    if constexpr (Friction::kHasCouple) torque -= lane(response.couple, i);
    contacts.point[c] = point;
    contacts.torque_b[c] = torque;
    contacts.wall_impulse[c] -= scene.step.length * force;
    contacts.wall_angular_impulse[c] += scene.step.length * torque;
  }
};

template <class Law, class Friction, class Record>
class SphereWallsPass : public Pass {
 public:
  explicit SphereWallsPass(const Law& law) : law_(law) {}

  std::string name() const override { return "sphere_wall_contacts"; }
  void launch(const Model& model, State& state, const Gate& gate) override {
    const ContactRange range = state.range[static_cast<int>(ContactKind::sphere_wall)];
    parallel_for_ranges(range.first, range.last,
                        ComputeSphereWalls<Law, Friction, Record>{contact_scene(model, state), law_}, gate);
  }

 private:
  Law law_;
};

}  // namespace

std::unique_ptr<Pass> make_sphere_wall_contacts_pass(const Scene& scene) {
  const auto make = [&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    const auto make_policies = [&](auto friction, auto record) -> std::unique_ptr<Pass> {
      return std::make_unique<SphereWallsPass<Law, decltype(friction), decltype(record)>>(law);
    };
    return std::visit(make_policies, sphere_friction<Law>(scene), record_policy(scene));
  };
  return std::visit(make, sphere_law(scene));
}

}  // namespace dem_gpu
