// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "shape_pipeline/ct_stack.h"
#include "workflows/digitize_batch.h"
#include "workflows/stage_tool.h"

namespace workflows {

/// How a stack becomes grains, as typed.
struct StackSettings {
  bool is_asked_for = false;  // --stack: folders are slices of one stack each
  std::string voxel;          // "12 um", or three lengths with commas between them
  std::string threshold;      // grey value of the file; empty: found
  std::string denoise = "gaussian";
  double sigma = 0.5, neck = 0.7, resolution = 10;
  bool keeps_cavities = false;
};

/// True if the inputs are stacks. Throws UsageError for stacks and other scans in one batch.
bool are_stacks(const DigitizeBatchOptions& options, const StackSettings& settings);

/// Stacks into a catalogue, one after the other; grains are named STACK_0001, ... from the largest down. A stack whose
/// grains are all there from the same bytes with the same options is skipped; one that cannot be read is kept as
/// rejected, so are grains of too few voxels. Throws like DigitizeBatch.
class StackBatch {
 public:
  StackBatch(const DigitizeBatchOptions& options, const StackSettings& settings);
  void run();

  const DigitizeBatchOptions& options() const { return options_; }
  const shape_pipeline::StackOptions& pipeline_options() const { return stack_options_; }

  /// Of the grains, or of the stack where there are none.
  const std::vector<DigitizedScan>& outcomes() const { return outcomes_; }

 private:
  void digitize(const std::filesystem::path& stack);
  bool is_done(const std::filesystem::path& stack, const catalog::Provenance& provenance);
  void store(const std::filesystem::path& stack, const std::string& name, const catalog::Provenance& provenance,
             shape_pipeline::StackGrain&& grain);
  std::string stack_name(const std::filesystem::path& stack) const;

  DigitizeBatchOptions options_;
  StackSettings settings_;
  shape_pipeline::StackOptions stack_options_;
  catalog::ShapeCatalog catalog_;
  BatchProgress progress_;
  std::vector<DigitizedScan> outcomes_;
};

}  // namespace workflows
