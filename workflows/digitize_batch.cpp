// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/digitize_batch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "catalog/input_error.h"
#include "shape_pipeline/scan_file.h"
#include "shape_pipeline/stack_sources.h"
#include "workflows/batch_refusal.h"
#include "workflows/grain_series.h"
#include "workflows/in_order.h"
#include "workflows/units.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using shape_pipeline::DigitizationOptions;
using shape_pipeline::ReconstructionMethod;
using shape_pipeline::RemeshingStyle;
using shape_pipeline::ScanTruth;

constexpr double kOtherUnit = 20;  // of sizes: inches for millimetres are 25

/// Catalogue names of the scans: the stem, with the ending added where two scans of the batch share it.
std::vector<std::string> shape_names(const std::vector<fs::path>& scans, const std::string& given_name) {
  if (!given_name.empty()) {
    if (scans.size() != 1)
      throw catalog::UsageError("--name fits one scan only; " + std::to_string(scans.size()) + " are given");
    return {given_name};
  }
  std::map<std::string, int> uses;
  for (const fs::path& scan : scans) ++uses[scan.stem().string()];
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const fs::path& scan : scans) {
    std::string name = scan.stem().string();
    if (uses[name] > 1 && scan.has_extension()) name += "_" + scan.extension().string().substr(1);
    if (!taken.insert(name).second)
      throw catalog::InputError(scan.string() + ": another scan of this batch is also named '" + name +
                                "'; digitise it by itself with --name");
    names.push_back(name);
  }
  return names;
}

/// The scans without those that are named again, by whatever path; these go to `repeated`. A link is a name of its own.
std::vector<fs::path> each_once(const std::vector<fs::path>& scans, std::vector<fs::path>& repeated) {
  std::set<fs::path> known;
  std::vector<fs::path> result;
  for (const fs::path& scan : scans) {
    const fs::path place = fs::weakly_canonical(fs::absolute(scan).parent_path()) / scan.filename();
    (known.insert(place).second ? result : repeated).push_back(scan);
  }
  return result;
}

/// A file that is there but may not be looked at is not missing.
bool is_missing(const fs::path& scan) {
  std::error_code error;
  return fs::status(scan, error).type() == fs::file_type::not_found;
}

std::string missing_reason(const fs::path& scan) {
  if (!fs::is_symlink(scan)) return scan.string() + ": no such file; check the path";
  return scan.string() + ": is a link that leads nowhere (to " + fs::read_symlink(scan).string() +
         "); mend or remove it";
}

/// Refuses pipes, sockets and devices: reading one may wait for ever.
void require_file(const fs::path& scan) {
  std::error_code error;
  const fs::file_type type = fs::status(scan, error).type();
  if (!error && type != fs::file_type::regular)
    throw catalog::InputError(scan.string() +
                              ": is no file but a pipe, socket, device or folder; copy the scan into a file");
}

/// A reason up to its first semicolon, without the file's name before it.
std::string first_reason(const DigitizedScan& outcome) {
  std::string text = outcome.reason;
  const std::string prefix = outcome.scan.string() + ": ";
  if (text.starts_with(prefix)) text.erase(0, prefix.size());
  text.resize(std::min(text.size(), text.find("; ")));
  if (std::count(text.begin(), text.end(), '(') > std::count(text.begin(), text.end(), ')')) text += ')';
  return text;
}

}  // namespace

DigitizationOptions digitization_options(const ScanSettings& settings) {
  if (settings.unit.empty())
    throw catalog::UsageError("--unit: scans carry no unit and none is guessed; state it, such as --unit mm (one of " +
                              accepted_units(Dimension::length) + ")");
  const std::optional<double> unit = length_unit(settings.unit);
  if (!unit)
    throw catalog::UsageError("--unit: expected one of " + accepted_units(Dimension::length) + ", found '" +
                              settings.unit + "'; state the unit of the scans' coordinates");
  DigitizationOptions options;
  options.metres_per_unit = *unit;
  options.drops_nan_points = settings.drops_nan;
  options.reconstruction.genus = settings.genus;
  options.bodies = settings.bodies;
  if (settings.method == "poisson") options.reconstruction.method = ReconstructionMethod::poisson;
  if (settings.method == "alpha-wrap") options.reconstruction.method = ReconstructionMethod::alpha_wrap;
  options.remeshing.face_limit = static_cast<std::size_t>(settings.faces);
  if (settings.is_isotropic) options.remeshing.style = RemeshingStyle::isotropic;
  if (!settings.size.empty()) {
    options.sieve_size = parse_quantity(settings.size, Dimension::length);
    constexpr double kSmallest = 1e-12,
                     kLargest = 1e12;  // [m], as of scans: beyond, moments leave the range of numbers
    if (!options.sieve_size || !(*options.sieve_size >= kSmallest && *options.sieve_size <= kLargest))
      throw catalog::UsageError("--size: expected a length from 1e-12 to 1e12 m such as '30 mm', found '" +
                                settings.size + "'");
  }
  return options;
}

std::string scan_options_text(const ScanSettings& settings, const std::optional<ScanTruth>& truth) {
  nlohmann::ordered_json options{{"unit", settings.unit},
                                 {"genus", settings.genus},
                                 {"faces", settings.faces},
                                 {"remeshing", settings.is_isotropic ? "isotropic" : "edge_collapse"},
                                 {"method", settings.method}};
  if (settings.drops_nan) options["drop_nan"] = true;
  if (settings.bodies != catalog::SeparateBodies::refuse)
    options["bodies"] = catalog::separate_bodies_name(settings.bodies);
  if (!settings.size.empty()) options["size"] = settings.size;
  if (truth) options["truth"] = {{"volume", truth->volume}, {"surface_area", truth->surface_area}};
  return options.dump();
}

std::string hash_of_files(const std::vector<fs::path>& files) {
  if (files.size() == 1) return catalog::sha256_of_file(files[0]);
  std::string list;
  for (const fs::path& file : files) list += catalog::sha256_of_file(file) + "\n";
  return catalog::sha256(list.data(), list.size());
}

bool have_one_source(const catalog::Provenance& a, const catalog::Provenance& b) {
  return a.source_sha256 == b.source_sha256 && a.options == b.options && a.tool_version == b.tool_version;
}

std::string sampling_note(const fs::path& scan, const std::vector<catalog::Check>& checks) {
  for (const catalog::Check& check : checks) {
    char count[32];
    std::snprintf(count, sizeof count, "%.0f ", check.figure);
    if (check.name == "subsampled_points") return scan.string() + ": " + count + check.detail;
  }
  return "";
}

// SQLite takes an empty file for a new database, but it may be anything of the user's.
catalog::ShapeCatalog open_catalog(const fs::path& path) {
  if (fs::is_regular_file(path) && fs::file_size(path) == 0)
    throw catalog::InputError(
        path.string() + ": is an empty file, expected a catalogue or a new name; delete the file or name another");
  return {path, catalog::ShapeCatalog::Access::read_write};
}

DigitizeBatch::DigitizeBatch(const DigitizeBatchOptions& options)
    : options_(options),
      digitization_(digitization_options(options.settings)),
      scans_(each_once(shape_pipeline::scan_files(options.inputs), repeated_)),
      names_(shape_names(scans_, options.name)),
      progress_("digitize", static_cast<int>(scans_.size())) {
  if (!options.truth_path.empty()) truths_ = shape_pipeline::read_truth(options.truth_path);
  // Without a scan to read no catalogue is made.
  if (std::any_of(scans_.begin(), scans_.end(), [](const fs::path& scan) { return !is_missing(scan); }))
    catalog_.emplace(open_catalog(options.catalog_path));
}

void DigitizeBatch::run() {
  OrderedWork<Prepared> work;
  work.count = static_cast<int>(scans_.size());
  // CGAL's Poisson function orders its cells by address: side by side, a cloud's mesh would depend on the threads.
  work.threads = 1;
  work.begin = [&](int s) { progress_.step(scans_[static_cast<std::size_t>(s)].filename().string()); };
  work.make = [&](int s) { return prepare(static_cast<std::size_t>(s)); };
  work.take = [&](int s, Prepared&& prepared) {
    outcomes_.push_back(stored(static_cast<std::size_t>(s), std::move(prepared)));
  };
  for (const fs::path& input : options_.inputs) note_what_is_passed_over(input);
  for (const fs::path& scan : repeated_) progress_.note(scan.string() + ": is given more than once; taken once");
  run_in_order(work);
  if (!digitization_.sieve_size) refuse_other_units();
  progress_.finish();
}

void DigitizeBatch::note_what_is_passed_over(const fs::path& input) {
  if (!fs::is_directory(input)) return;
  int stacks = 0;
  for (const auto& entry : fs::directory_iterator(input)) stacks += shape_pipeline::has_stack_ending(entry.path());
  if (stacks > 0)
    progress_.note(input.string() + ": " + std::to_string(stacks) +
                   " CT stacks or images in it are passed over; give them by themselves, without scans of other kinds");
}

void DigitizeBatch::refuse_other_units() {
  const auto size = [](const DigitizedScan& outcome) { return std::cbrt(outcome.summary.volume); };
  std::vector<double> sizes;
  for (const DigitizedScan& outcome : outcomes_)
    if (!outcome.is_bad()) sizes.push_back(size(outcome));
  if (sizes.size() < 3) return;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  for (std::size_t s = 0; s < outcomes_.size(); ++s) {
    DigitizedScan& outcome = outcomes_[s];
    if (outcome.status != "stored") continue;  // what was there before has been looked at
    const double ratio = size(outcome) / *middle;
    if (ratio <= kOtherUnit && ratio >= 1 / kOtherUnit) continue;
    char text[160];
    std::snprintf(text, sizeof text, ": is %.3g times as large as the median of the shapes of this batch, ", ratio);
    outcome.reason = outcome.scan.string() + text +
                     "so that its unit may be another; digitise it by itself, with the --unit that is its own";
    outcome.status = "rejected";
    outcome.summary = {};
    const std::string hash = catalog_->shape(*catalog_->find(outcome.name)).provenance.source_sha256;
    catalog_->remove_shape(outcome.name);
    catalog_->store_rejected({outcome.name, outcome.scan.filename().string(), hash, outcome.reason});
    progress_.note("rejected: " + outcome.reason);
  }
}

/// Errors of the scan make an outcome; errors of the catalogue, such as a lock, are not the scan's and end the batch.
DigitizeBatch::Prepared DigitizeBatch::prepare(std::size_t s) {
  const fs::path& scan = scans_[s];
  Prepared result;
  if (is_missing(scan)) return {"missing", missing_reason(scan), {}, {}};
  result.provenance = {scan.filename().string(), "", tool_version(), ""};
  const auto known = truths_.find(scan.filename().string());
  const auto truth = known == truths_.end() ? std::nullopt : std::optional(known->second);
  result.provenance.options = scan_options_text(options_.settings, truth);
  result.reason = refusal_of(scan.string(), [&] {
    require_file(scan);
    result.provenance.source_sha256 = catalog::sha256_of_file(scan);
  });
  if (result.reason.empty()) {
    if (const auto id = catalog_->find(names_[s]);
        id && have_one_source(catalog_->shape(*id).provenance, result.provenance)) {
      result.status = "skipped";
      return result;
    }
  }
  if (result.reason.empty())
    result.reason =
        refusal_of(scan.string(), [&] { result.shape.emplace(shape_pipeline::digitize(scan, digitization_, truth)); });
  result.status = result.reason.empty() ? "stored" : "rejected";
  return result;
}

DigitizedScan DigitizeBatch::stored(std::size_t s, Prepared&& prepared) {
  const std::string& name = names_[s];
  DigitizedScan outcome{scans_[s], name, prepared.status, prepared.reason, {}};
  if (prepared.status == "missing") progress_.note(prepared.reason);
  if (prepared.status == "rejected") {
    catalog_->store_rejected(
        {name, prepared.provenance.source_file, prepared.provenance.source_sha256, prepared.reason});
    progress_.note("rejected: " + prepared.reason);
  }
  if (outcome.is_bad()) return outcome;
  if (prepared.status == "skipped") {
    catalog_->forget_rejected(name);
  } else {
    prepared.shape->name = name;
    prepared.shape->provenance = prepared.provenance;
    if (const std::string note = sampling_note(scans_[s], prepared.shape->checks); !note.empty()) progress_.note(note);
    remove_stale_grains(*catalog_, {name, kPlateDigits}, 0, prepared.provenance, progress_);
    catalog_->store_shape(*prepared.shape);
  }
  outcome.summary = catalog_->summary(*catalog_->find(name));
  return outcome;
}

std::string failures_text(const std::vector<DigitizedScan>& outcomes) {
  std::string lines;
  int bad = 0;
  for (const DigitizedScan& outcome : outcomes) {
    if (!outcome.is_bad()) continue;
    ++bad;
    lines += "  " + outcome.name + ": " + first_reason(outcome) + "\n";
  }
  if (bad == 0) return "";
  return std::to_string(bad) + " of " + std::to_string(outcomes.size()) + " scans rejected or missing:\n" + lines;
}

std::string failed_checks_text(const std::vector<DigitizedScan>& outcomes) {
  std::string lines;
  int count = 0;
  for (const DigitizedScan& outcome : outcomes) {
    if (outcome.summary.failed_checks.empty()) continue;
    ++count;
    lines += "  " + outcome.name + ":";
    for (const std::string& check : outcome.summary.failed_checks) lines += " " + check;
    lines += "\n";
  }
  if (count == 0) return "";
  return std::to_string(count) + " of " + std::to_string(outcomes.size()) +
         " scans stored with checks that did not pass (talus catalog show tells by how much):\n" + lines;
}

}  // namespace workflows
