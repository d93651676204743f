// SPDX-License-Identifier: Apache-2.0
#include "workflows/thread_count.h"

#include <string>

#include "catalog/input_error.h"

#if defined(TALUS_BACKEND_TBB)
#include <tbb/global_control.h>

#include <memory>
#elif defined(TALUS_BACKEND_OMP)
#include <omp.h>
#endif

namespace workflows {

void set_thread_count(int threads) {
#if defined(TALUS_BACKEND_TBB)
  static std::unique_ptr<tbb::global_control> limit;  // in force as long as it lives
  limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
#elif defined(TALUS_BACKEND_OMP)
  omp_set_num_threads(threads);
#else
  throw catalog::UsageError("--threads " + std::to_string(threads) + ": the engine of this build (" + backend_name() +
                            ") has no choice of threads; leave the option out");
#endif
}

const char* backend_name() { return TALUS_BACKEND_NAME; }

}  // namespace workflows
