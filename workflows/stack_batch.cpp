// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/stack_batch.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "catalog/input_error.h"
#include "workflows/batch_refusal.h"
#include "workflows/grain_series.h"
#include "workflows/units.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using shape_pipeline::StackDenoising;
using shape_pipeline::StackOptions;

constexpr char kSizeCheck[] = "stack_grains";  // its figure: the grains that the stack gave

std::array<double, 3> voxel_size(const std::string& text) {
  std::vector<double> sides;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::optional<double> side =
        parse_quantity(part.substr(std::min(part.find_first_not_of(' '), part.size())), Dimension::length);
    sides.push_back(side.value_or(0));
  }
  const auto is_good = [](double side) { return side > 0 && std::isfinite(side); };
  if ((sides.size() != 1 && sides.size() != 3) || !std::all_of(sides.begin(), sides.end(), is_good))
    throw catalog::UsageError(
        "--voxel: expected a length above 0 such as '12 um', or three such as '12 um, 12 um, 20 um', "
        "found '" +
        text + "'");
  return sides.size() == 1 ? std::array<double, 3>{sides[0], sides[0], sides[0]}
                           : std::array<double, 3>{sides[0], sides[1], sides[2]};
}

StackOptions stack_options(const DigitizeBatchOptions& batch, const StackSettings& settings) {
  if (!batch.settings.size.empty() || !batch.truth_path.empty() || batch.settings.genus != 0 ||
      batch.settings.method != "auto" || batch.settings.drops_nan || !batch.settings.unit.empty())
    throw catalog::UsageError(
        "--unit, --size, --truth, --genus, --method and --drop-nan are for scans, not for stacks");
  StackOptions options;
  if (!settings.voxel.empty()) options.voxel_size = voxel_size(settings.voxel);
  if (!settings.threshold.empty()) {
    double value = 0;
    const char* const end = settings.threshold.data() + settings.threshold.size();
    const auto [rest, error] = std::from_chars(settings.threshold.data(), end, value);
    if (error != std::errc{} || rest != end || !std::isfinite(value))
      throw catalog::UsageError("--threshold: expected a grey value of the file, found '" + settings.threshold + "'");
    options.threshold = value;
  }
  options.denoising = settings.denoise == "median" ? StackDenoising::median
                      : settings.denoise == "none" ? StackDenoising::none
                                                   : StackDenoising::gaussian;
  options.gaussian_sigma = settings.sigma;
  options.neck_ratio = settings.neck;
  options.least_diameter = settings.resolution;
  options.keeps_cavities = settings.keeps_cavities;
  options.remeshing.face_limit = static_cast<std::size_t>(batch.settings.faces);
  if (batch.settings.is_isotropic) options.remeshing.style = shape_pipeline::RemeshingStyle::isotropic;
  return options;
}

/// Everything that changes the result, as JSON.
std::string options_text(const DigitizeBatchOptions& batch, const StackSettings& settings) {
  nlohmann::ordered_json options{{"voxel", settings.voxel.empty() ? "of the file" : settings.voxel},
                                 {"denoise", settings.denoise},
                                 {"threshold", settings.threshold.empty() ? "volume-true" : settings.threshold},
                                 {"neck", settings.neck},
                                 {"resolution", settings.resolution},
                                 {"cavities", settings.keeps_cavities ? "kept" : "filled"},
                                 {"faces", batch.settings.faces},
                                 {"remeshing", batch.settings.is_isotropic ? "isotropic" : "edge_collapse"}};
  if (settings.denoise == "gaussian") options["sigma"] = settings.sigma;
  return options.dump();
}

/// The stack's own path, without the slash that a folder's name may end in.
fs::path without_slash(const fs::path& stack) { return stack.has_filename() ? stack : stack.parent_path(); }

/// None where the stack cannot be looked into.
std::vector<fs::path> sources_if_readable(const fs::path& stack) {
  std::vector<fs::path> sources;
  refusal_of(stack.string(), [&] { sources = shape_pipeline::stack_sources(stack); });
  return sources;
}

std::string summary_text(const std::string& name, const shape_pipeline::StackSummary& summary) {
  char text[240];
  std::snprintf(text, sizeof text,
                "%s: %zu grains, %zu of them refused; threshold %.1f; dropped: %zu cut by the border, %zu specks",
                name.c_str(), summary.grains, summary.refused, summary.threshold, summary.at_border, summary.specks);
  return text;
}

}  // namespace

bool are_stacks(const DigitizeBatchOptions& options, const StackSettings& settings) {
  const auto is_stack = [&](const fs::path& input) {
    return shape_pipeline::has_stack_ending(input) || (settings.is_asked_for && fs::is_directory(input));
  };
  const auto stacks = std::count_if(options.inputs.begin(), options.inputs.end(), is_stack);
  if (stacks != 0 && stacks != static_cast<std::ptrdiff_t>(options.inputs.size()))
    throw catalog::UsageError("stacks and other scans do not go together; digitise them one after the other");
  if (stacks == 0 && settings.is_asked_for)
    throw catalog::UsageError("--stack: expected a folder of slices, or TIFF, NRRD or RAW files");
  return stacks != 0;
}

StackBatch::StackBatch(const DigitizeBatchOptions& options, const StackSettings& settings)
    : options_(options),
      settings_(settings),
      stack_options_(stack_options(options, settings)),
      catalog_(open_catalog(options.catalog_path)),
      progress_("digitize", static_cast<int>(options.inputs.size())) {
  if (!options.name.empty() && options.inputs.size() != 1)
    throw catalog::UsageError("--name fits one stack only; " + std::to_string(options.inputs.size()) + " are given");
}

void StackBatch::run() {
  for (const fs::path& stack : options_.inputs) {
    progress_.step(stack_name(stack));
    const std::string reason = refusal_of(stack.string(), [&] { digitize(stack); });
    if (reason.empty()) continue;
    const std::string name = stack_name(stack);
    catalog_.store_rejected(
        {name, without_slash(stack).filename().string(), hash_if_readable(sources_if_readable(stack)), reason});
    progress_.note("rejected: " + reason);
    outcomes_.push_back({stack, name, "rejected", reason, {}});
  }
  progress_.finish();
}

void StackBatch::digitize(const fs::path& stack) {
  const std::string name = stack_name(stack);
  const GrainSeries series{name};
  const catalog::Provenance provenance{without_slash(stack).filename().string(),
                                       hash_of_files(shape_pipeline::stack_sources(stack)), tool_version(),
                                       options_text(options_, settings_)};
  if (is_done(stack, provenance)) return;
  std::vector<shape_pipeline::StackGrain> grains;  // their number, which the first already tells, is known at the end
  const shape_pipeline::StackSummary summary = shape_pipeline::digitize_stack(
      stack, stack_options_, [&](shape_pipeline::StackGrain&& grain) { grains.push_back(std::move(grain)); });
  const std::size_t stored = summary.grains - summary.refused;
  remove_stale_grains(catalog_, series, stored, provenance, progress_);
  catalog_.forget_rejected(name);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    grains[g].shape.checks.push_back({kSizeCheck, true, static_cast<double>(stored), "grains stored of this stack"});
    store(stack, series.name(g + 1), provenance, std::move(grains[g]));
  }
  progress_.note(summary_text(name, summary));
}

/// Grains are stored from the largest down, and those refused come last.
bool StackBatch::is_done(const fs::path& stack, const catalog::Provenance& provenance) {
  const GrainSeries series{stack_name(stack)};
  std::vector<DigitizedScan> found;
  std::size_t expected = 1;
  for (std::size_t g = 1; g <= expected; ++g) {
    const auto id = catalog_.find(series.name(g));
    if (!id) return false;
    const catalog::ShapeRecord shape = catalog_.shape(*id);
    if (!have_one_source(shape.provenance, provenance)) return false;
    for (const catalog::Check& check : shape.checks)
      if (check.name == kSizeCheck) expected = static_cast<std::size_t>(check.figure);
    found.push_back({stack, series.name(g), "skipped", "", catalog_.summary(*id)});
  }
  outcomes_.insert(outcomes_.end(), found.begin(), found.end());
  return true;
}

void StackBatch::store(const fs::path& stack, const std::string& name, const catalog::Provenance& provenance,
                       shape_pipeline::StackGrain&& grain) {
  if (!grain.refusal.empty()) {
    const std::string reason = stack.string() + ": grain " + name + ": " + grain.refusal +
                               "; scan it at a higher resolution or lower --resolution";
    catalog_.store_rejected({name, provenance.source_file, provenance.source_sha256, reason});
    outcomes_.push_back({stack, name, "rejected", reason, {}});
    return;
  }
  catalog_.forget_rejected(name);
  grain.shape.name = name;
  grain.shape.provenance = provenance;
  const catalog::ShapeId id = catalog_.store_shape(grain.shape);
  outcomes_.push_back({stack, name, "stored", "", catalog_.summary(id)});
}

std::string StackBatch::stack_name(const fs::path& stack) const {
  if (!options_.name.empty()) return options_.name;
  const fs::path clean = without_slash(stack);
  return fs::is_directory(stack) ? clean.filename().string() : clean.stem().string();
}

}  // namespace workflows
