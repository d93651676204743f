// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

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
  virtual void run(const Model& model, State& state) = 0;
};

}  // namespace dem_gpu
