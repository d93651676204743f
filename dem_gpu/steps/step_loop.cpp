// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/steps/step_loop.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace dem_gpu {
namespace {

// Steps of a block. A look at the device costs about as much as a step of a small scene; a block whose list is worn
// half way launches the other half for nothing. So: a quarter of what lists live, between these.
constexpr int kShortestBlock = 8;
constexpr int kLongestBlock = 64;
/// Taking down costs as much as launching: lists that are worn before are not worth it.
constexpr int kCaptureAge = 64;

}  // namespace

StepLoop::StepLoop(std::vector<std::unique_ptr<Pass>> passes, StepBlocks blocks)
    : passes_(std::move(passes)), blocks_(blocks), halted_at_(1, 0) {
  while (!passes_[static_cast<std::size_t>(list_pass_)]->renews_list()) ++list_pass_;
}

void StepLoop::advance(const Model& model, State& state, std::int64_t steps) {
  while (steps > 0) {
    const int block = steps_without_host(model, state, std::min<std::int64_t>(steps, block_length(state)));
    if (block > 0) {
      steps -= run_block(model, state, block);
    } else {
      run_passes(model, state, 0);
      --steps;
    }
  }
}

void StepLoop::run_passes(const Model& model, State& state, std::size_t first) {
  for (std::size_t p = first; p < passes_.size(); ++p) passes_[p]->run(model, state);
  ++counts_.by_themselves;
  if (state.columns_version == list_version_) return;
  list_version_ = state.columns_version;
  last_life_ = state.step - listed_step_;
  listed_step_ = state.step;
}

int StepLoop::block_length(const State& state) const {
  const auto life = static_cast<std::uint64_t>(std::max({std::int64_t{0}, last_life_, state.step - listed_step_}));
  return static_cast<int>(std::clamp<std::uint64_t>(std::bit_floor(life / 4), kShortestBlock, kLongestBlock));
}

int StepLoop::steps_without_host(const Model& model, const State& state, std::int64_t most) const {
  // The first step differs from all others; the first one with new columns makes scratch columns fit them.
  if (blocks_ == StepBlocks::none || state.step == 0 || state.list_is_stale || state.columns_version != list_version_)
    return 0;
  int steps = 0;
  const auto needs_host = [&](const auto& pass) { return pass->needs_host(model, state, state.step + steps + 1); };
  while (steps < most && std::none_of(passes_.begin(), passes_.end(), needs_host)) ++steps;
  return steps;
}

std::int64_t StepLoop::run_block(const Model& model, State& state, int steps) {
  const std::int64_t start = state.step;
  const int pass_count = static_cast<int>(passes_.size()), end = steps * pass_count;
  halted_at_[0] = end;
  if (use_graph(model, state, steps)) {
    graph_.replay();
    ++counts_.replays;
  } else {
    launch_steps(model, state, steps, nullptr);
  }
  wait_for_launches();
  const int halted = halted_at_[0], done = halted / pass_count;
  counts_.in_blocks += done;
  state.step = start + done;
  if (halted == end) return done;
  ++counts_.halts;
  ++state.step;  // the bodies have been moved
  for (const auto& pass : passes_) pass->take_back(model, state);
  run_passes(model, state, static_cast<std::size_t>(halted % pass_count));
  return done + 1;
}

void StepLoop::launch_steps(const Model& model, State& state, int steps, [[maybe_unused]] LaunchList* record) {
  const int pass_count = static_cast<int>(passes_.size());
  for (int step = 0; step < steps; ++step)
    for (int p = 0; p < pass_count; ++p) {
      Gate gate{pointer(halted_at_), step * pass_count + p, step * pass_count + list_pass_};
#ifndef TALUS_BACKEND_CUDA
      gate.record = record;
#endif
      passes_[static_cast<std::size_t>(p)]->launch(model, state, gate);
    }
}

bool StepLoop::repeats_itself(const Model& model, const State& state) const {
  return std::all_of(passes_.begin(), passes_.end(),
                     [&](const auto& pass) { return pass->repeats_itself(model, state); });
}

/// Not for a block most of which is left out.
bool StepLoop::use_graph(const Model& model, State& state, int steps) {
  if (blocks_ != StepBlocks::captured || state.step - listed_step_ < kCaptureAge || !repeats_itself(model, state))
    return false;
  const int length = block_length(state);
  if (2 * steps < length) return false;
  if (graph_version_ == list_version_ && graph_steps_ == length) return true;
  const std::int64_t start = state.step;
  graph_version_ = -1;
  graph_.capture([&](LaunchList* record) { launch_steps(model, state, length, record); });
  state.step = start;
  graph_version_ = list_version_;
  graph_steps_ = length;
  return true;
}

}  // namespace dem_gpu
