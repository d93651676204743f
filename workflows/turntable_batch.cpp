// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/turntable_batch.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "catalog/input_error.h"
#include "workflows/batch_refusal.h"
#include "workflows/grain_series.h"
#include "workflows/units.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using shape_pipeline::TurntableOptions;

TurntableOptions turntable_options(const DigitizeBatchOptions& batch, const TurntableSettings& settings) {
  if (!batch.settings.size.empty() || !batch.truth_path.empty() || batch.settings.method != "auto" ||
      batch.settings.drops_nan || !batch.settings.unit.empty())
    throw catalog::UsageError("--unit, --size, --truth, --method and --drop-nan are for scans, not for a turntable");
  TurntableOptions options;
  if (!settings.pixel.empty()) {
    options.pixel_size = parse_quantity(settings.pixel, Dimension::length).value_or(0);
    if (!(options.pixel_size > 0) || !std::isfinite(options.pixel_size))
      throw catalog::UsageError("--pixel: expected a length above 0 such as '20 um', found '" + settings.pixel + "'");
  }
  options.cells = settings.cells;
  options.genus = batch.settings.genus;
  options.remeshing.face_limit = static_cast<std::size_t>(batch.settings.faces);
  if (batch.settings.is_isotropic) options.remeshing.style = shape_pipeline::RemeshingStyle::isotropic;
  return options;
}

/// Everything that changes the result, as JSON.
std::string options_text(const DigitizeBatchOptions& batch, const TurntableSettings& settings) {
  return nlohmann::ordered_json{{"turntable", true},
                                {"pixel", settings.pixel.empty() ? "of turntable.json" : settings.pixel},
                                {"cells", settings.cells},
                                {"genus", batch.settings.genus},
                                {"faces", batch.settings.faces},
                                {"remeshing", batch.settings.is_isotropic ? "isotropic" : "edge_collapse"}}
      .dump();
}

fs::path without_slash(const fs::path& folder) { return folder.has_filename() ? folder : folder.parent_path(); }

}  // namespace

TurntableBatch::TurntableBatch(const DigitizeBatchOptions& options, const TurntableSettings& settings)
    : options_(options),
      turntable_(turntable_options(options, settings)),
      options_text_(options_text(options, settings)),
      catalog_(open_catalog(options.catalog_path)),
      progress_("digitize", static_cast<int>(options.inputs.size())) {
  if (!options.name.empty() && options.inputs.size() != 1)
    throw catalog::UsageError("--name fits one turntable only; " + std::to_string(options.inputs.size()) +
                              " are given");
}

void TurntableBatch::run() {
  for (const fs::path& folder : options_.inputs) {
    const std::string name = grain_name(folder);
    progress_.step(name);
    const std::string reason = refusal_of(folder.string(), [&] { digitize(folder); });
    if (reason.empty()) continue;
    std::vector<fs::path> sources;  // none where the folder cannot be looked into
    refusal_of(folder.string(), [&] { sources = shape_pipeline::turntable_sources(folder); });
    catalog_.store_rejected({name, without_slash(folder).filename().string(), hash_if_readable(sources), reason});
    progress_.note("rejected: " + reason);
    outcomes_.push_back({folder, name, "rejected", reason, {}});
  }
  progress_.finish();
}

void TurntableBatch::digitize(const fs::path& folder) {
  const std::string name = grain_name(folder);
  const catalog::Provenance provenance{without_slash(folder).filename().string(),
                                       hash_of_files(shape_pipeline::turntable_sources(folder)), tool_version(),
                                       options_text_};
  if (const auto id = catalog_.find(name); id && have_one_source(catalog_.shape(*id).provenance, provenance)) {
    outcomes_.push_back({folder, name, "skipped", "", catalog_.summary(*id)});
    return;
  }
  catalog::ShapeRecord shape = shape_pipeline::digitize_turntable(shape_pipeline::read_turntable(folder, turntable_),
                                                                  folder.string(), turntable_);
  for (const catalog::Check& check : shape.checks)
    if (check.name == "turntable_views" && !check.passed) progress_.note(name + ": " + check.detail);
  catalog_.forget_rejected(name);
  shape.name = name;
  shape.provenance = provenance;
  const catalog::ShapeId id = catalog_.store_shape(shape);
  outcomes_.push_back({folder, name, "stored", "", catalog_.summary(id)});
}

std::string TurntableBatch::grain_name(const fs::path& folder) const {
  return options_.name.empty() ? without_slash(folder).filename().string() : options_.name;
}

}  // namespace workflows
