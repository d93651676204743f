// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace gpu_check {

struct Device {
  std::string name;
  std::string capability;   // "9.0"
  std::string driver;       // as /proc/driver/nvidia/version has it; empty where that is not
  std::string newest_cuda;  // that the driver knows, "13.0"
  std::string runtime;      // CUDA this was built with
  double memory = 0;        // [bytes]
  int multiprocessors = 0;
};

/// The first device; none without one, without a driver, and in builds for the CPU. `why`: what is missing.
std::optional<Device> find_device(std::string& why);

}  // namespace gpu_check
