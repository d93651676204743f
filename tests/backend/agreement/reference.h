// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "tests/backend/agreement/agreement_cases.h"

namespace agreement {

inline constexpr int kManySteps = 10;  // friction's springs take part from the second step on
inline constexpr int kSeeds[] = {1, 2, 3, 4};

/// A case on one back end.
struct Outcome {
  dem_gpu::Snapshot start, after_one, after_many;
  std::vector<Bulk> bulks;  // one a seed
};

/// The same start on this build's back end.
Outcome outcome_from(const Case& agreement_case, const dem_gpu::Snapshot& start);

/// FOLDER/NAME/start.h5, after_one.h5, after_many.h5 and bulk.json.
void write_outcome(const std::filesystem::path& folder, const Case& agreement_case, const Outcome& outcome);
/// Throws catalog::InputError for a file that is missing or damaged.
Outcome read_outcome(const std::filesystem::path& folder, const Case& agreement_case);

}  // namespace agreement
