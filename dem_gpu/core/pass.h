// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "dem_gpu/core/gate.h"

namespace dem_gpu {

struct Model;
struct State;

/// One piece of a step. A step is a list of passes; each is a function of the model (constant) and the state.
class Pass {
 public:
  virtual ~Pass() = default;
  virtual std::string name() const = 0;
  /// Does it find forces from a given state, so that it also runs once at time 0? Else it carries the state on in time.
  virtual bool finds_forces() const { return true; }
  /// The pass with all that the host has to do for it: looks at what the device has found where it must.
  virtual void run(const Model& model, State& state) { launch(model, state, Gate{}); }

  // As part of a block of steps, which the host launches without a look at what they find.

  /// The pass without the host: launches its kernels behind `gate` and waits for nothing. A kernel that finds that the
  /// host is needed halts the block at the pass whose `run` will see to it.
  virtual void launch(const Model& model, State& state, const Gate& gate) = 0;
  /// Is it known beforehand that the host is needed in the step that ends with number `step`?
  virtual bool needs_host(const Model& /*model*/, const State& /*state*/, std::int64_t /*step*/) const { return false; }
  /// Does it launch the same kernels with the same arguments in every step between two neighbour lists?
  virtual bool repeats_itself(const Model& /*model*/, const State& /*state*/) const { return true; }
  /// Does it renew the neighbour list, so that a worn list halts a block here?
  virtual bool renews_list() const { return false; }
  /// The host has launched steps beyond state.step that were not done: its own part of the state is taken back there.
  virtual void take_back(const Model& /*model*/, State& /*state*/) {}
};

}  // namespace dem_gpu
