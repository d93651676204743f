// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/micrograph_batch.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "catalog/input_error.h"
#include "shape_pipeline/ct_stack.h"
#include "shape_pipeline/described_shape.h"
#include "workflows/atomic_file.h"
#include "workflows/batch_refusal.h"
#include "workflows/grain_series.h"
#include "workflows/micrograph_tables.h"
#include "workflows/plain_name.h"
#include "workflows/text_format.h"
#include "workflows/units.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using shape_pipeline::Micrograph;

/// A length above 0, or 0 where the option is not given.
double length_of(const std::string& option, const std::string& text, const char* example) {
  if (text.empty()) return 0;
  const std::optional<double> length = parse_quantity(text, Dimension::length);
  if (!length || !(*length > 0))
    throw catalog::UsageError(option + ": expected a length above 0 such as '" + example + "', found '" + text + "'");
  return *length;
}

double third_axis_of(const std::string& text) {
  if (text == "drawn") return 0;
  double ratio = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, ratio);
  if (error != std::errc{} || rest != end || !(ratio > 0 && ratio <= 1))
    throw catalog::UsageError("--third-axis: expected 'drawn', or S/I above 0 and at most 1, found '" + text + "'");
  return ratio;
}

/// The images meant, each once: files as given, of folders those with an image's ending, by name.
std::vector<fs::path> image_files(const std::vector<fs::path>& inputs) {
  std::vector<fs::path> images;
  for (const fs::path& input : inputs) {
    if (!fs::is_directory(input)) {
      images.push_back(input);
      continue;
    }
    std::set<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(input)) {
      const std::string ending = shape_pipeline::lower_ending(entry.path());
      if (shape_pipeline::has_image_ending(entry.path()) || ending == ".tif" || ending == ".tiff")
        found.insert(entry.path());
    }
    if (found.empty()) throw catalog::InputError(input.string() + ": no images (PNG, JPEG, BMP, TIFF) in this folder");
    images.insert(images.end(), found.begin(), found.end());
  }
  std::map<std::string, fs::path> stems;
  std::vector<fs::path> once;
  for (const fs::path& image : images) {
    const auto [known, is_new] = stems.emplace(image.stem().string(), fs::weakly_canonical(image));
    if (is_new)
      once.push_back(image);
    else if (known->second != fs::weakly_canonical(image))
      throw catalog::InputError(image.string() + ": another image of this batch is also named '" + known->first +
                                "'; digitise it by itself");
  }
  return once;
}

void require_no_scan_options(const DigitizeBatchOptions& batch) {
  if (!batch.settings.size.empty() || !batch.truth_path.empty() || batch.settings.genus != 0 ||
      batch.settings.method != "auto" || batch.settings.drops_nan || !batch.settings.unit.empty())
    throw catalog::UsageError(
        "--unit, --size, --truth, --genus, --method and --drop-nan are for scans, not for micrographs");
}

fs::path folder_of(const DigitizeBatchOptions& batch, const MicrographSettings& settings) {
  if (!settings.out.empty()) return settings.out;
  if (batch.catalog_path.empty())
    throw catalog::UsageError("no place for the tables named; add --into powder.talus or --out DIR");
  return batch.catalog_path.parent_path() / (batch.catalog_path.stem().string() + "_outlines");
}

/// What of the options changes the outlines and shapes, as JSON.
std::string options_text(const MicrographSettings& settings) {
  nlohmann::ordered_json options;
  if (!settings.pixel.empty()) options["pixel"] = settings.pixel;
  if (!settings.scale_bar.empty()) options["scale_bar"] = settings.scale_bar;
  options["grains"] = settings.has_dark_grains ? "dark" : "bright";
  options["least_diameter"] = settings.least_diameter;
  options["population"] = settings.population;
  options["third_axis"] = settings.third_axis;
  options["seed"] = settings.seed;
  return options.dump();
}

std::string summary_text(const std::string& name, const Micrograph& micrograph) {
  std::string text = formatted(
      "%s: %zu whole grains; left out: %zu cut by the border, %zu specks, %zu threads and films; a pixel is %.6g um",
      name.c_str(), micrograph.grains.size(), micrograph.at_border.size(), micrograph.specks, micrograph.films,
      1e6 * micrograph.pixel_size);
  if (micrograph.bar_pixels > 0) text += formatted(", the scale bar %.1f pixels", micrograph.bar_pixels);
  if (micrograph.strip_top < micrograph.height)
    text += formatted("; the data strip from row %d on was left out", micrograph.strip_top);
  return text;
}

std::string comparison_text(const shape_pipeline::FormComparison& row) {
  return formatted("mean (spread) of %s: outlines %.4g (%.2g), silhouettes %.4g (%.2g)", row.name.c_str(),
                   row.measured_mean, row.measured_spread, row.made_mean, row.made_spread);
}

}  // namespace

bool are_micrographs(const DigitizeBatchOptions& options, const MicrographSettings& settings) {
  if (settings.is_asked_for()) return true;
  const auto images = std::count_if(options.inputs.begin(), options.inputs.end(), shape_pipeline::has_image_ending);
  if (images != 0 && images != static_cast<std::ptrdiff_t>(options.inputs.size()))
    throw catalog::UsageError("micrographs and other scans do not go together; digitise them one after the other");
  return images != 0;
}

MicrographBatch::MicrographBatch(const DigitizeBatchOptions& options, const MicrographSettings& settings)
    : options_(options),
      settings_(settings),
      images_(image_files(options.inputs)),
      progress_("digitize", static_cast<int>(images_.size())) {
  require_no_scan_options(options);
  if (!settings.pixel.empty() && !settings.scale_bar.empty())
    throw catalog::UsageError("--pixel and --scale-bar both state the size of a pixel; give one of them");
  image_options_.pixel_size = length_of("--pixel", settings.pixel, "0.5 um");
  image_options_.scale_bar_length = length_of("--scale-bar", settings.scale_bar, "100 um");
  image_options_.has_dark_grains = settings.has_dark_grains;
  image_options_.least_diameter = settings.least_diameter;
  population_options_ = {settings.population, settings.seed, third_axis_of(settings.third_axis)};
  settings_.out = folder_of(options, settings);
  name_ = !options.name.empty() ? options.name
          : images_.size() == 1 ? images_[0].stem().string()
                                : options.catalog_path.stem().string();
  if (settings.population == 0) return;
  if (options.catalog_path.empty())
    throw catalog::UsageError("no catalogue named for the population; add --into powder.talus, or --population 0");
  if (!is_plain_name(name_)) throw catalog::InputError(shown_name(name_) + ": " + kPlainName);
  catalog_.emplace(open_catalog(options.catalog_path));
}

void MicrographBatch::run() {
  std::error_code error;
  fs::create_directories(settings_.out, error);
  if (!fs::is_directory(settings_.out))
    throw catalog::InputError(settings_.out.string() + ": cannot be made a folder; name another by --out");
  for (const fs::path& image : images_) {
    progress_.step(image.filename().string());
    const std::string reason = refusal_of(image.string(), [&] { digitize(image); });
    if (!reason.empty()) reject(image, image.stem().string(), reason);
  }
  if (settings_.population > 0 && !read_.empty()) {
    const std::string reason = refusal_of(name_, [&] { store_population(); });
    if (!reason.empty()) reject(read_.front(), name_ + "_population", reason);
  }
  progress_.finish();
}

void MicrographBatch::digitize(const fs::path& image) {
  Micrograph micrograph = digitize_micrograph(image, image_options_);
  const std::string stem = image.stem().string();
  if (!is_plain_name(stem)) throw catalog::InputError(image.string() + ": " + kPlainName);
  write_whole(settings_.out / (stem + ".csv"), outline_table(stem, micrograph));
  write_whole(settings_.out / (stem + ".json"), outline_json(micrograph, provenance_of({image})));
  shape_pipeline::write_overlay(settings_.out / (stem + ".png"), image, micrograph);
  for (const shape_pipeline::MicrographGrain& grain : micrograph.grains) {
    outlines_.push_back(grain.outline);
    for (shape_pipeline::PlanePoint& p : outlines_.back())
      p = {p[0] * micrograph.pixel_size, p[1] * micrograph.pixel_size};
  }
  coarsest_pixel_ = std::max(coarsest_pixel_, micrograph.pixel_size);
  read_.push_back(image);
  if (catalog_) catalog_->forget_rejected(stem);
  progress_.note(summary_text(image.filename().string(), micrograph));
  micrographs_.push_back({image, std::move(micrograph)});
}

void MicrographBatch::store_population() {
  const catalog::Provenance provenance = provenance_of(read_);
  if (is_done(provenance)) return;
  const shape_pipeline::MatchedPopulation population =
      matched_population(outlines_, coarsest_pixel_, population_options_);
  remove_stale_grains(*catalog_, {name_}, static_cast<std::size_t>(settings_.population), provenance, progress_);
  catalog_->forget_rejected(name_ + "_population");
  write_whole(settings_.out / (name_ + "_population.json"), population_json(population, provenance));
  std::vector<catalog::Check> checks{{"assumed_third_axis", true, population_options_.third_axis,
                                      population.assumption + "; figure: S/I given, 0 if drawn"}};
  for (const shape_pipeline::FormComparison& row : population.comparison) {
    checks.push_back({"population_" + row.name, row.agrees(settings_.population), row.made_mean / row.measured_mean - 1,
                      "whole population, " + comparison_text(row)});
    progress_.note(comparison_text(row));
  }
  for (int g = 1; g <= settings_.population; ++g) {
    catalog::ShapeRecord shape = shape_pipeline::described_shape(population.grains[static_cast<std::size_t>(g) - 1], 0);
    shape.name = shape_name(g);
    shape.provenance = provenance;
    shape.checks.insert(shape.checks.end(), checks.begin(), checks.end());
    const catalog::ShapeId id = catalog_->store_shape(shape);
    outcomes_.push_back({read_.front(), shape.name, "stored", "", catalog_->summary(id)});
  }
}

bool MicrographBatch::is_done(const catalog::Provenance& provenance) {
  std::vector<DigitizedScan> found;
  for (int g = 1; g <= settings_.population; ++g) {
    const auto id = catalog_->find(shape_name(g));
    if (!id || !have_one_source(catalog_->shape(*id).provenance, provenance)) return false;
    found.push_back({read_.front(), shape_name(g), "skipped", "", catalog_->summary(*id)});
  }
  outcomes_.insert(outcomes_.end(), found.begin(), found.end());
  return true;
}

void MicrographBatch::reject(const fs::path& source, const std::string& name, const std::string& reason) {
  if (catalog_) catalog_->store_rejected({name, source.filename().string(), hash_if_readable({source}), reason});
  progress_.note("rejected: " + reason);
  outcomes_.push_back({source, name, "rejected", reason, {}});
}

/// Of one image its own name and hash; of several those of the list of theirs.
catalog::Provenance MicrographBatch::provenance_of(const std::vector<fs::path>& images) const {
  std::string names, hashes;
  for (const fs::path& image : images) {
    names += (names.empty() ? "" : " ") + image.filename().string();
    hashes += catalog::sha256_of_file(image) + "\n";
  }
  const std::string hash =
      images.size() == 1 ? hashes.substr(0, hashes.size() - 1) : catalog::sha256(hashes.data(), hashes.size());
  return {names, hash, tool_version(), options_text(settings_)};
}

std::string MicrographBatch::shape_name(int number) const {
  return GrainSeries{name_}.name(static_cast<std::size_t>(number));
}

}  // namespace workflows
