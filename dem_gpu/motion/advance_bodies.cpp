// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/broad_phase/list_wear.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/energy/energy.h"
#include "dem_gpu/motion/motion_passes.h"
#include "dem_gpu/motion/rigid_body.h"
#include "dem_gpu/motion/round_bodies.h"

namespace dem_gpu {
namespace {

struct AdvanceBody {
  BodyView bodies;
  Real time_step;  // [s]
  ListWear wear;

  TALUS_HD void operator()(int i) const {
    if (!bodies.is_moving(i)) {
      wear.note(Real(0));  // a wall may have come
      return;
    }
    const Vec3 kick = (time_step / 2 * bodies.inverse_mass[i]) * bodies.force[i];
    const Vec3 velocity = bodies.velocity[i] + kick;
    bodies.position[i] += time_step * velocity;
    bodies.velocity[i] = velocity;
    bodies.mean_velocity[i] = velocity;
    bodies.predicted_velocity[i] = velocity + kick;
    if (RoundBodies::is_round(bodies.inertia[i]))
      turn_round_body(i);
    else
      turn_body(i);
    const Real displacement = displacement_since_listed(i, velocity);
    bodies.listed_displacement[i] = displacement;
    wear.note(displacement);
    if (bodies.travel)
      bodies.travel[i] +=
          time_step * (norm(velocity) + bodies.bounding_radius[i] * norm(bodies.mean_angular_velocity[i]));
  }

 private:
  /// Equal moments: the axis stays, so that one turn does the whole step.
  TALUS_HD void turn_round_body(int i) const {
    const Quaternion before = bodies.orientation[i];
    const Mat3 rotation = rotation_matrix(before);
    const Vec3 kick = (time_step / 2 / bodies.inertia[i].x) * bodies.torque[i];
    const Vec3 in_body = bodies.angular_velocity[i] + transpose_times(rotation, kick);
    const Vec3 spin = rotation * in_body;
    bodies.orientation[i] = normalized(before * turn_by(time_step * in_body));
    bodies.angular_velocity[i] = in_body;
    bodies.mean_angular_velocity[i] = spin;
    bodies.predicted_angular_velocity[i] = spin + kick;
  }

  TALUS_HD void turn_body(int i) const {
    const Real half = time_step / 2;
    const Vec3 inertia = bodies.inertia[i];
    const Quaternion before = bodies.orientation[i];
    Quaternion after = before;
    Vec3 momentum = hadamard(inertia, bodies.angular_velocity[i]) + half * rotate_back(before, bodies.torque[i]);
    rotate_freely(after, momentum, inertia, time_step);
    bodies.orientation[i] = after;
    bodies.angular_velocity[i] = over(momentum, inertia);
    bodies.mean_angular_velocity[i] = mean_angular_velocity(before, after, time_step);
    const Vec3 predicted = momentum + half * rotate_back(after, bodies.torque[i]);
    bodies.predicted_angular_velocity[i] = rotate(after, over(predicted, inertia));
  }

  TALUS_HD static Vec3 over(const Vec3& a, const Vec3& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

  /// Infinite for a body that is lost: not finite, or so fast that it could pass through another.
  TALUS_HD Real displacement_since_listed(int i, const Vec3& velocity) const {
    const Real distance = norm(bodies.position[i] - bodies.listed_position[i]);
    const Real spin_squared = norm_squared(bodies.angular_velocity[i]), radius = bodies.turning_radius(i);
    const Real turning = radius > 0 ? std::sqrt(spin_squared) * radius : 0;
    const Real travel = time_step * (norm(velocity) + turning);
    const bool is_sound =
        distance < Real(1e300) && spin_squared < Real(1e300) && travel < kTravelShare * bodies.least_width[i];
    return is_sound ? distance : Real(HUGE_VAL);
  }
};

struct AdvanceRange {
  AdvanceBody one;

  TALUS_HD void operator()(int begin, int end) const {
    const RoundBodies round{one.bodies, one.time_step, one.wear};
    int i = begin;
    while (i < end) {
      const bool is_block = kRealLanes > 1 && i + kRealLanes <= end;
      if (is_block && round.are_here(i) && round.advance(i)) {
        i += kRealLanes;
        continue;
      }
      const int last = is_block ? i + kRealLanes : i + 1;
      for (; i < last; ++i) one(i);
    }
  }
};

class AdvanceBodies : public Pass {
 public:
  std::string name() const override { return "advance_bodies"; }
  bool finds_forces() const override { return false; }
  void launch(const Model& model, State& state, const Gate& gate) override {
    ++state.step;
    const BodyView bodies = view(model.bodies, state.bodies);
    const ListWear wear{state.skin, state.walls.largest_displacement(state.listed_time, state.time(model)),
                        pointer(state.list_is_worn), gate.halted_at, gate.list_place};
    parallel_for_ranges(0, bodies.count, AdvanceRange{{bodies, model.time_step, wear}}, gate);
  }
};

class AdvanceWalls : public Pass {
 public:
  std::string name() const override { return "advance_walls"; }
  bool finds_forces() const override { return false; }
  void run(const Model& model, State& state) override {
    if (!state.walls.move_to(state.time(model))) return;
    close_accounts_of_absent_walls(model, state);
    state.list_is_stale = true;
  }
  /// The host moves the walls, which it knows how to do beforehand, as it launches the steps.
  void launch(const Model& model, State& state, const Gate& /*gate*/) override {
    if (state.walls.any_moves()) state.walls.move_to(state.time(model));
  }
  bool needs_host(const Model& model, const State& state, std::int64_t step) const override {
    return state.walls.comes_or_goes(static_cast<Real>(step) * model.time_step);
  }
  bool repeats_itself(const Model& /*model*/, const State& state) const override { return !state.walls.any_moves(); }
  void take_back(const Model& model, State& state) override {
    if (!state.walls.any_moves()) return;
    state.walls.move_to(static_cast<Real>(state.step - 1) * model.time_step);
    state.walls.move_to(state.time(model));
  }
};

}  // namespace

std::unique_ptr<Pass> make_advance_bodies_pass() { return std::make_unique<AdvanceBodies>(); }
std::unique_ptr<Pass> make_advance_walls_pass() { return std::make_unique<AdvanceWalls>(); }

}  // namespace dem_gpu
