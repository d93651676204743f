// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/backend/agreement/reference.h"

namespace agreement {

/// One figure of a case on two back ends.
struct Agreement {
  std::string what;
  double difference = 0;
  double tolerance = 0;

  bool holds() const { return difference <= tolerance; }  // not for NaN
};

/// Differences after the steps, over the largest change since `start` (forces: over the largest force), and of the
/// bulk, in Student's t over the seeds.
std::vector<Agreement> compare(const Outcome& reference, const Outcome& own);

}  // namespace agreement
