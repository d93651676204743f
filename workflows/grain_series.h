// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "workflows/stage_tool.h"

namespace workflows {

/// The grains of one source: "stack_0001", "stack_0002", ... of the stem "stack" and 4 digits.
struct GrainSeries {
  std::string stem;
  int digits = 4;

  std::string name(std::size_t number) const;
};

inline constexpr int kPlateDigits = 2;  // of the grains of a plate

/// Takes what an earlier run with other bytes or options made of the same source (by its file's name) out of the
/// catalogue: the grains of the series, shapes and rejected ones, and the shape of the stem where the source is parted
/// now. `count` grains follow (0: one shape of the stem's name); beyond them the notice names what goes, and what stays
/// in the series because it has another source.
void remove_stale_grains(catalog::ShapeCatalog& catalog, const GrainSeries& series, std::size_t count,
                         const catalog::Provenance& provenance, BatchProgress& progress);

/// Hash of the files a source consists of, or empty where one of them cannot be read: for what is rejected.
std::string hash_if_readable(const std::vector<std::filesystem::path>& files);

}  // namespace workflows
