// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "shape_pipeline/turntable.h"
#include "workflows/digitize_batch.h"
#include "workflows/stage_tool.h"

namespace workflows {

/// How images of a turntable become a grain, as typed.
struct TurntableSettings {
  bool is_asked_for = false;  // --turntable: each folder is the views of one grain
  std::string pixel;          // "20 um", of an orthographic camera; empty: turntable.json says
  int cells = 160;
};

/// Folders of silhouettes into a catalogue, one after the other, each a grain named as its folder. One that is there
/// from the same bytes with the same options is skipped; one that gives no grain is kept as rejected. Views that cannot
/// be used are named and left out, and the check `turntable_views` does not pass then. Throws like DigitizeBatch.
class TurntableBatch {
 public:
  TurntableBatch(const DigitizeBatchOptions& options, const TurntableSettings& settings);
  void run();

  const DigitizeBatchOptions& options() const { return options_; }
  const shape_pipeline::TurntableOptions& pipeline_options() const { return turntable_; }

  /// Of the folders, in their order.
  const std::vector<DigitizedScan>& outcomes() const { return outcomes_; }

 private:
  void digitize(const std::filesystem::path& folder);
  std::string grain_name(const std::filesystem::path& folder) const;

  DigitizeBatchOptions options_;
  shape_pipeline::TurntableOptions turntable_;
  std::string options_text_;
  catalog::ShapeCatalog catalog_;
  BatchProgress progress_;
  std::vector<DigitizedScan> outcomes_;
};

}  // namespace workflows
