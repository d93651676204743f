// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace workflows {

/// What --threads takes at most: OpenMP ends the process where the system gives it no more threads.
inline constexpr int kMostThreads = 1024;

/// Bounds the threads of the engine for the rest of the process; results do not depend on it.
/// Throws catalog::UsageError if this build's back end has no such choice.
void set_thread_count(int threads);

/// Where the engine of this build runs: "CUDA", "OMP", "TBB" or "CPP".
const char* backend_name();

}  // namespace workflows
