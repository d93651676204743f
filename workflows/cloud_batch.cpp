// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/cloud_batch.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "catalog/input_error.h"
#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/floor_plane.h"
#include "shape_pipeline/registration.h"
#include "shape_pipeline/scan_file.h"
#include "workflows/batch_refusal.h"
#include "workflows/grain_series.h"
#include "workflows/text_format.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using shape_pipeline::PartialScan;
using shape_pipeline::PointCloud;

constexpr char kGrainsCheck[] = "plate_grains";  // its figure: the grains that the cloud was separated into

std::string options_text(const ScanSettings& settings, const CloudSettings& cloud) {
  nlohmann::ordered_json options = nlohmann::ordered_json::parse(scan_options_text(settings, std::nullopt));
  options["register"] = cloud.is_registered;
  options["remove_plane"] = cloud.removes_plane;
  options["separate"] = cloud.is_separated;
  if (cloud.is_separated) options["grain_points"] = cloud.grain_points;
  return options.dump();
}

std::string source_text(const std::vector<fs::path>& files) {
  std::string names;
  for (const fs::path& file : files) names += (names.empty() ? "" : ", ") + file.filename().string();
  return names;
}

}  // namespace

CloudBatch::CloudBatch(const DigitizeBatchOptions& options, const CloudSettings& settings)
    : options_(options),
      settings_(settings),
      digitization_(digitization_options(options.settings)),
      catalog_(open_catalog(options.catalog_path)),
      progress_("digitize", 1) {
  if (!options.truth_path.empty())
    throw catalog::UsageError("--truth does not go with --register, --remove-plane and --separate");
  const std::vector<fs::path> files = shape_pipeline::scan_files(options.inputs);
  if (settings.is_registered) {
    if (files.size() < 2)
      throw catalog::UsageError("--register needs two partial scans or more; " + std::to_string(files.size()) +
                                " is given");
    jobs_.push_back({options.name.empty() ? files.front().stem().string() : options.name, files});
  } else {
    if (!options.name.empty() && files.size() != 1)
      throw catalog::UsageError("--name fits one scan only; " + std::to_string(files.size()) + " are given");
    for (const fs::path& file : files)
      jobs_.push_back({options.name.empty() ? file.stem().string() : options.name, {file}});
  }
  progress_ = BatchProgress("digitize", static_cast<int>(jobs_.size()));
}

void CloudBatch::run() {
  for (const Job& job : jobs_) {
    progress_.step(job.name);
    const std::string reason = refusal_of(job.files.front().string(), [&] { digitize(job); });
    if (!reason.empty()) reject(job, job.name, hash_if_readable(job.files), reason);
  }
  progress_.finish();
}

CloudBatch::Grain CloudBatch::merged(const Job& job) const {
  Grain whole;
  std::vector<PartialScan> parts;
  for (const fs::path& file : job.files) {
    if (shape_pipeline::scan_kind(file) != shape_pipeline::ScanKind::point_cloud)
      throw catalog::InputError(file.string() +
                                ": is a mesh; --register, --remove-plane and --separate are for point clouds");
    shape_pipeline::CloudReading reading;
    reading.metres_per_unit = digitization_.metres_per_unit;
    reading.drops_nan_points = digitization_.drops_nan_points;
    shape_pipeline::CloudFile read = shape_pipeline::read_cloud(file, reading);
    whole.checks.insert(whole.checks.end(), read.notes.begin(), read.notes.end());
    if (const std::string note = sampling_note(file, read.notes); !note.empty()) whole.notes.push_back(note);
    PointCloud cloud = std::move(read.cloud);
    if (settings_.removes_plane) {
      shape_pipeline::ClearedCloud cleared = shape_pipeline::without_floor(cloud, file.string());
      cloud = std::move(cleared.cloud);
      whole.checks.insert(whole.checks.end(), cleared.checks.begin(), cleared.checks.end());
    }
    parts.push_back({file.string(), std::move(cloud)});
  }
  if (!settings_.is_registered) {
    whole.cloud = std::move(parts.front().cloud);
    return whole;
  }
  shape_pipeline::RegisteredParts registered = shape_pipeline::register_parts(parts);
  whole.cloud = std::move(registered.merged);
  whole.checks.insert(whole.checks.end(), registered.checks.begin(), registered.checks.end());
  return whole;
}

PointCloud CloudBatch::source_cloud(const fs::path& file) const {
  for (const Job& job : jobs_)
    if (job.files.front() == file) return merged(job).cloud;
  throw std::invalid_argument(file.string() + ": is no source of this batch");
}

void CloudBatch::digitize(const Job& job) {
  for (const fs::path& file : job.files) {
    std::error_code error;
    if (fs::status(file, error).type() != fs::file_type::regular)
      throw catalog::InputError(file.string() + ": no such file; check the path");
  }
  const catalog::Provenance provenance{source_text(job.files), hash_of_files(job.files), tool_version(),
                                       options_text(options_.settings, settings_)};
  if (is_done(job, provenance)) return;
  const Grain whole = merged(job);
  for (const std::string& note : whole.notes) progress_.note(note);
  const GrainSeries series{job.name, kPlateDigits};
  if (!settings_.is_separated) {
    remove_stale_grains(catalog_, series, 0, provenance, progress_);
    return store(job, job.name, provenance, whole);
  }

  const auto found = shape_pipeline::separated_grains(whole.cloud, static_cast<std::size_t>(settings_.grain_points));
  if (found.grains.empty() && found.small.empty())
    throw catalog::InputError(job.files.front().string() + ": holds no grain; scan more points");
  remove_stale_grains(catalog_, series, found.grains.size(), provenance, progress_);
  catalog_.forget_rejected(job.name);
  std::size_t number = 0;
  for (const PointCloud& cloud : found.grains) {
    Grain grain{cloud, whole.checks, {}};
    grain.checks.push_back({kGrainsCheck, true, static_cast<double>(found.grains.size()), "grains of this cloud"});
    grain.checks.push_back({"grain_gap", true, found.gap, "distance that separates two grains [m]"});
    store(job, series.name(++number), provenance, grain);
  }
  for (const std::size_t points : found.small) {
    ++number;
    reject(job, series.name(number), provenance.source_sha256,
           job.files.front().string() +
               formatted(": grain %zu has %zu points, expected at least %d", number, points, settings_.grain_points) +
               "; scan it with more points or lower --grain-points");
  }
  if (found.specks > 0) progress_.note(job.name + formatted(": %zu stray points dropped", found.specks));
}

bool CloudBatch::is_done(const Job& job, const catalog::Provenance& provenance) {
  std::vector<DigitizedScan> known;
  std::size_t expected = 1;
  for (std::size_t g = 1; g <= expected; ++g) {
    const std::string name = settings_.is_separated ? GrainSeries{job.name, kPlateDigits}.name(g) : job.name;
    const auto id = catalog_.find(name);
    if (!id) return false;
    const catalog::ShapeRecord shape = catalog_.shape(*id);
    if (!have_one_source(shape.provenance, provenance)) return false;
    for (const catalog::Check& check : shape.checks)
      if (check.name == kGrainsCheck) expected = static_cast<std::size_t>(check.figure);
    known.push_back({job.files.front(), name, "skipped", "", catalog_.summary(*id)});
  }
  outcomes_.insert(outcomes_.end(), known.begin(), known.end());
  return true;
}

void CloudBatch::store(const Job& job, const std::string& name, const catalog::Provenance& provenance,
                       const Grain& grain) {
  catalog::ShapeRecord shape;
  const std::string reason = refusal_of(job.files.front().string(), [&] {
    shape = shape_pipeline::digitize_cloud(grain.cloud, job.files.front(), digitization_, grain.checks);
  });
  if (!reason.empty()) return reject(job, name, provenance.source_sha256, reason);
  catalog_.forget_rejected(name);
  shape.name = name;
  shape.provenance = provenance;
  const catalog::ShapeId id = catalog_.store_shape(shape);
  outcomes_.push_back({job.files.front(), name, "stored", "", catalog_.summary(id)});
}

void CloudBatch::reject(const Job& job, const std::string& name, const std::string& hash, const std::string& reason) {
  catalog_.store_rejected({name, source_text(job.files), hash, reason});
  progress_.note("rejected: " + reason);
  outcomes_.push_back({job.files.front(), name, "rejected", reason, {}});
}

}  // namespace workflows
