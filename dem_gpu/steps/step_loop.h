// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/core/launch_graph.h"
#include "dem_gpu/core/pass.h"
#include "dem_gpu/simulation.h"

namespace dem_gpu {

/// The passes of a step, step after step: one by one with the host, or in blocks of steps that the host launches
/// without a look at what they find.
///
/// Each pass of each step of a block has a place. A kernel that finds that the host is needed (the neighbour list is
/// worn, a body is lost or leaves) halts the block at the place of the pass whose `run` sees to it; the gates of all
/// places from there on are closed. The host then finishes that step as if it had come there by itself, so that the
/// outcome is the same to the last bit. A block that is to be shorter than what was captured is halted at its end from
/// the start.
class StepLoop {
 public:
  StepLoop(std::vector<std::unique_ptr<Pass>> passes, StepBlocks blocks);

  void set_blocks(StepBlocks blocks) { blocks_ = blocks; }
  void advance(const Model& model, State& state, std::int64_t steps);
  const std::vector<std::unique_ptr<Pass>>& passes() const { return passes_; }
  StepCounts counts() const { return counts_; }

 private:
  /// Steps that can be launched from here on without the host, at most `most`; 0: the next one needs it.
  int steps_without_host(const Model& model, const State& state, std::int64_t most) const;
  int block_length(const State& state) const;
  bool repeats_itself(const Model& model, const State& state) const;
  void run_passes(const Model& model, State& state, std::size_t first);
  /// Returns how many steps it has done.
  std::int64_t run_block(const Model& model, State& state, int steps);
  void launch_steps(const Model& model, State& state, int steps, LaunchList* record);
  bool use_graph(const Model& model, State& state, int steps);

  std::vector<std::unique_ptr<Pass>> passes_;
  int list_pass_ = 0;  // that renews the neighbour list
  StepBlocks blocks_;
  DeviceVector<int> halted_at_;  // of the block, see Gate
  // The neighbour list that the last step by itself left behind, by State::columns_version.
  std::int64_t list_version_ = -1;
  std::int64_t listed_step_ = 0;  // when it was made
  std::int64_t last_life_ = 0;    // steps that the list before it served
  LaunchGraph graph_;
  std::int64_t graph_version_ = -1;  // of the list whose steps it holds
  int graph_steps_ = 0;
  StepCounts counts_;
};

}  // namespace dem_gpu
