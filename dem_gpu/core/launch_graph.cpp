// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/core/launch_graph.h"

#ifdef TALUS_BACKEND_CUDA
#include "dem_gpu/core/device_stream.h"
#endif

namespace dem_gpu {

#ifdef TALUS_BACKEND_CUDA

struct LaunchGraph::Captured {
  cudaGraphExec_t executable = nullptr;

  ~Captured() { forget(); }
  void forget() {
    if (executable) cudaGraphExecDestroy(executable);
    executable = nullptr;
  }
  /// A graph of the same kernels with other arguments, as that of the next neighbour list mostly is, takes the place of
  /// the last one without being made anew.
  void take(cudaGraph_t graph) {
    cudaGraphExecUpdateResultInfo result;
    if (executable && cudaGraphExecUpdate(executable, graph, &result) == cudaSuccess) return;
    cudaGetLastError();  // that of an update that did not fit
    forget();
    check_device(cudaGraphInstantiate(&executable, graph, 0), "making a graph of launches");
  }
};

LaunchList* LaunchGraph::begin() {
  check_device(cudaStreamBeginCapture(device_stream(), cudaStreamCaptureModeThreadLocal), "taking down launches");
  return nullptr;
}

void LaunchGraph::end() {
  cudaGraph_t graph = nullptr;
  check_device(cudaStreamEndCapture(device_stream(), &graph), "taking down launches");
  try {
    captured_->take(graph);
  } catch (...) {
    cudaGraphDestroy(graph);
    throw;
  }
  check_device(cudaGraphDestroy(graph), "giving back a graph of launches");
}

void LaunchGraph::abandon() {
  cudaGraph_t graph = nullptr;
  cudaStreamEndCapture(device_stream(), &graph);
  if (graph) cudaGraphDestroy(graph);
  cudaGetLastError();  // the fault that is being thrown says more
}

void LaunchGraph::replay() {
  check_device(cudaGraphLaunch(captured_->executable, device_stream()), "launching a graph");
}

#else

struct LaunchGraph::Captured {
  LaunchList launches;
};

LaunchList* LaunchGraph::begin() {
  captured_->launches.clear();
  return &captured_->launches;
}
void LaunchGraph::end() {}
void LaunchGraph::abandon() { captured_->launches.clear(); }
void LaunchGraph::replay() {
  for (const auto& launch : captured_->launches) launch();
}

#endif

LaunchGraph::LaunchGraph() : captured_(std::make_unique<Captured>()) {}
LaunchGraph::~LaunchGraph() = default;
LaunchGraph::LaunchGraph(LaunchGraph&&) noexcept = default;

}  // namespace dem_gpu
