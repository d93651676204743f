// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/gpu_check/device.h"

#if defined(TALUS_BACKEND_CUDA)
#include <cuda_runtime_api.h>

#include <fstream>
#endif

namespace gpu_check {

#if defined(TALUS_BACKEND_CUDA)
namespace {

/// 13000 is "13.0".
std::string version_text(int version) {
  return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

std::string driver_line() {
  std::ifstream file("/proc/driver/nvidia/version");
  std::string line;
  std::getline(file, line);
  return line;
}

}  // namespace

std::optional<Device> find_device(std::string& why) {
  cudaDeviceProp properties;
  int driver = 0, runtime = 0;
  cudaError_t status = cudaGetDeviceProperties(&properties, 0);
  if (status == cudaSuccess) status = cudaDriverGetVersion(&driver);
  if (status == cudaSuccess) status = cudaRuntimeGetVersion(&runtime);
  if (status != cudaSuccess) {
    why = cudaGetErrorString(status);
    return std::nullopt;
  }
  return Device{properties.name,
                std::to_string(properties.major) + "." + std::to_string(properties.minor),
                driver_line(),
                version_text(driver),
                version_text(runtime),
                static_cast<double>(properties.totalGlobalMem),
                properties.multiProcessorCount};
}
#else
std::optional<Device> find_device(std::string& why) {
  why = "this build is for the CPU";
  return std::nullopt;
}
#endif

}  // namespace gpu_check
