// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "tests/backend/gpu_check/child_process.h"
#include "tests/backend/gpu_check/plan.h"

namespace gpu_check {

using Json = nlohmann::ordered_json;

/// Where programs and results lie. Of programs: tests/NAME, bin/NAME.
struct Place {
  std::filesystem::path folder, logs;
};

// Each stage keeps within `budget` [s]. A row has a "result": "passed", "failed", "timed out" or "not run", and where
// it is not the first, "why".

/// A row a test program: tests, failures, skipped, seconds. Programs run beside each other, each in a few shards.
Json run_tests(const Place& place, const std::vector<TestProgram>& tests, double budget);

/// One row with the figures of `agreement --compare`.
Json run_agreement(const Place& place, double budget);

/// A row a bench: bodies, milliseconds a step (median, least and most of the windows), particle-steps a second. A bench
/// that ran out of time has the windows that it finished.
Json run_benches(const Place& place, const std::vector<Bench>& benches, double budget);

/// The test program under compute-sanitizer's memcheck; "not run" where that is not installed.
Json run_sanitizer(const Place& place, const std::string& test_program, double budget);

/// "passed", "timed out", "failed" or "not run", by how a program ended.
std::string result_of(const Ending& ending);
std::string text_of(const std::filesystem::path& file);

}  // namespace gpu_check
