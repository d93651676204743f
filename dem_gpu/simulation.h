// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "dem_gpu/scene.h"
#include "dem_gpu/snapshot.h"

namespace dem_gpu {

/// Energy accounts since time 0 [J]. Balance: input = stored + lost, up to `imbalance`.
struct EnergyLedger {
  double kinetic = 0;
  double gravitational = 0;  // potential, relative to time 0
  double elastic_normal = 0;
  double elastic_tangential = 0;
  double wall_work = 0;  // done by moving objects on the bodies
  double removed = 0;    // kinetic + gravitational + elastic of bodies that left by the outflow
  double initial = 0;    // kinetic and elastic at time 0
  struct ClassLoss {
    std::string contact_class;  // "particle-particle", "particle-shell", ...
    double normal = 0;          // dissipated by damping
    double shear = 0;           // dissipated by friction
  };
  std::vector<ClassLoss> dissipation;

  double dissipated() const;
  /// initial + wall_work - (kinetic + gravitational + elastic + removed + dissipated).
  double imbalance() const;
  /// What the balance is compared with: the most energy put in so far, i.e. |initial| + energy released by gravity +
  /// positive wall work, now or when bodies were listed anew before [J].
  double throughput = 0;
};

/// Force and torque that the bodies exert on a wall, averaged over the time since the last row.
struct WallLoad {
  Vec3 force;        // [N]
  Vec3 torque;       // about the motion's rotation centre [N m]
  double power = 0;  // that the wall's motion puts into the bodies [W]
  double work = 0;   // since time 0 [J]
};

/// Things a run must own up to.
struct RunQuality {
  double largest_overlap = 0;             // depth / equivalent diameter of the smaller body, over the run [-]
  double smallest_steps_per_contact = 0;  // from the stiffness really met [-]
  std::int64_t list_rebuilds = 0;
};

struct BulkState {
  int active_bodies = 0;
  double active_mass = 0;  // [kg]
  int removed_bodies = 0;
  double removed_mass = 0;  // [kg]
  int contacts = 0;         // that carry force
  int candidate_pairs = 0;  // that the neighbour list holds, looked at in each step
};

/// How the steps reach the device. The outcome is the same to the last bit.
enum class StepBlocks {
  none,      // step by step, the host looks at each: what the CPU does
  launched,  // the host launches blocks of steps and looks after each block
  captured,  // as launched; blocks are CUDA graphs where steps repeat themselves: what the GPU does
};

/// How steps were done, since the run began.
struct StepCounts {
  std::int64_t by_themselves = 0;  // with the host, from the beginning or from where a block was halted
  std::int64_t in_blocks = 0;
  std::int64_t halts = 0;    // blocks that ended before their time
  std::int64_t replays = 0;  // blocks that were captured
};

/// One DEM run. Deterministic: the same scene gives the same bytes whatever the thread count.
class Simulation {
 public:
  /// Throws catalog::InputError if check(scene) does, and if bodies overlap at time 0 by more than
  /// scene.run.largest_start_overlap.
  explicit Simulation(const Scene& scene);
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  /// Runs n steps. Throws std::runtime_error naming step, body and remedy if a body's state is no longer finite, if a
  /// point of one moves more than a quarter of its least width in a step, or if energy comes from nothing.
  void advance(std::int64_t steps);

  /// For comparisons; the back end's own way is set from the start.
  void set_step_blocks(StepBlocks blocks);
  StepCounts step_counts() const;

  /// Gives a body an impulse through its centre and an angular impulse, world frame: a load from outside the engine,
  /// force x time_step() before each step. The ledger counts the energy as initial.
  /// Throws catalog::InputError if there is no such body.
  void push(int body, const Vec3& impulse, const Vec3& angular_impulse);

  double time() const;
  double time_step() const;
  std::int64_t step() const;
  std::vector<std::string> pass_names() const;

  EnergyLedger ledger() const;              // all zero if the scene has no ledger
  std::vector<WallLoad> take_wall_loads();  // n_walls; restarts the averages
  RunQuality quality() const;
  BulkState bulk() const;

  Snapshot snapshot() const;
  RunGeometry geometry() const;

  /// The whole state, bit for bit. write_checkpoint writes beside, flushes, keeps the last one as
  /// checkpoint_previous.h5.
  void write_checkpoint(const std::filesystem::path& run_folder) const;
  /// Goes on from the checkpoint in run_folder (the previous one if the last is damaged). Returns what there is to
  /// tell: nothing, or that it went on from the previous one and why. Throws catalog::InputError if it belongs to
  /// another scene, version or precision.
  std::string read_checkpoint(const std::filesystem::path& run_folder);

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace dem_gpu
