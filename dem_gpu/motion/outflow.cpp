// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/energy/energy.h"
#include "dem_gpu/motion/motion_passes.h"

namespace dem_gpu {
namespace {

struct MarkLeaving {
  BodyView bodies;
  Outflow outflow;
  int* leaving;
  Gate gate;

  TALUS_HD void operator()(int i) const {
    leaving[i] = bodies.is_moving(i) && dot(bodies.position[i], outflow.direction) < outflow.height;
    if (leaving[i] != 0 && gate.halted_at) raise(gate.halted_at, gate.place);
  }
};

class OutflowPass : public Pass {
 public:
  std::string name() const override { return "outflow"; }
  bool finds_forces() const override { return false; }
  void run(const Model& model, State& state) override {
    launch(model, state, Gate{});
    if (max_of(leaving_, 0) == 0) return;
    remove_bodies(model, state, to_host(leaving_));
  }
  /// Who leaves halts the block here.
  void launch(const Model& model, State& state, const Gate& gate) override {
    const BodyView bodies = view(model.bodies, state.bodies);
    leaving_.resize(static_cast<std::size_t>(bodies.count));
    parallel_for(0, bodies.count, MarkLeaving{bodies, *model.scene.outflow, pointer(leaving_), gate}, gate);
  }

 private:
  DeviceVector<int> leaving_;
};

}  // namespace

std::unique_ptr<Pass> make_outflow_pass() { return std::make_unique<OutflowPass>(); }

}  // namespace dem_gpu
