// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "dem_gpu/core/gate.h"

namespace dem_gpu {

/// Launches behind gates, taken down once and made again as often as asked: a CUDA graph, on the CPU a list. Their
/// arguments stay those of the time they were taken down.
class LaunchGraph {
 public:
  LaunchGraph();
  ~LaunchGraph();
  LaunchGraph(LaunchGraph&&) noexcept;

  /// launches(record): hands `record` to the gates and makes the launches, which are taken down, not carried out. They
  /// replace those of before, and may neither wait nor allocate.
  template <class Launches>
  void capture(const Launches& launches) {
    LaunchList* record = begin();
    try {
      launches(record);
    } catch (...) {
      abandon();
      throw;
    }
    end();
  }
  /// Makes them all and waits for none.
  void replay();

 private:
  LaunchList* begin();
  void end();
  void abandon();

  struct Captured;
  std::unique_ptr<Captured> captured_;
};

}  // namespace dem_gpu
