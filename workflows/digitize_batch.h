// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "shape_pipeline/digitization.h"
#include "workflows/stage_tool.h"

namespace workflows {

/// How scans become shapes, as typed.
struct ScanSettings {
  std::string unit, size, method = "auto";
  int genus = 0, faces = 10000;
  bool is_isotropic = false, drops_nan = false;
  catalog::SeparateBodies bodies = catalog::SeparateBodies::refuse;
};

struct DigitizeBatchOptions {
  std::vector<std::filesystem::path> inputs;  // scan files, or folders of them
  std::filesystem::path catalog_path, truth_path;
  std::string name;  // of the only scan; empty: the file's name without ending
  ScanSettings settings;
};

struct DigitizedScan {
  std::filesystem::path scan;
  std::string name, status;  // "stored", "skipped", "rejected" or "missing"
  std::string reason;        // of "rejected" and "missing"
  catalog::ShapeSummary summary;

  bool is_bad() const { return status == "rejected" || status == "missing"; }
};

/// "rock.ply: ..." for a shape of whose scan a sample was read; else empty.
std::string sampling_note(const std::filesystem::path& scan, const std::vector<catalog::Check>& checks);

/// What the scans are digitised with. Throws UsageError for settings that cannot be.
shape_pipeline::DigitizationOptions digitization_options(const ScanSettings& settings);

/// Everything that changes the result, as JSON; part of the test whether a scan is done already.
std::string scan_options_text(const ScanSettings& settings, const std::optional<shape_pipeline::ScanTruth>& truth);

/// Hash of what a shape is made from: of one file its own, of several that of the list of theirs.
std::string hash_of_files(const std::vector<std::filesystem::path>& files);

/// Whether both come from the same bytes with the same options by the same version.
bool have_one_source(const catalog::Provenance& a, const catalog::Provenance& b);

/// The catalogue to fill, made where it is missing. Throws InputError for an empty file of that name.
catalog::ShapeCatalog open_catalog(const std::filesystem::path& path);

/// Scans into a catalogue, one after the other. A scan that is there from the same bytes with the same options is
/// skipped, one named twice is taken once with a notice; a bad one is kept as rejected with its reason, and the batch
/// goes on. The constructor throws catalog::InputError or UsageError for options that fit no batch, and for a catalogue
/// that cannot be opened; run() where it cannot be written.
class DigitizeBatch {
 public:
  explicit DigitizeBatch(const DigitizeBatchOptions& options);

  /// Each scan in turn. Of three shapes or more, one that is now stored and more than twenty times as large or small as
  /// the median is taken out again and rejected: its unit is another, or it does not belong to the others.
  void run();

  const DigitizeBatchOptions& options() const { return options_; }

  /// Of the scans done, in the order of the scans.
  const std::vector<DigitizedScan>& outcomes() const { return outcomes_; }

 private:
  /// A scan on its way to the catalogue.
  struct Prepared {
    std::string status, reason;
    catalog::Provenance provenance;
    std::optional<catalog::ShapeRecord> shape;
  };
  Prepared prepare(std::size_t scan);
  DigitizedScan stored(std::size_t scan, Prepared&& prepared);
  void refuse_other_units();
  void note_what_is_passed_over(const std::filesystem::path& input);

  DigitizeBatchOptions options_;
  shape_pipeline::DigitizationOptions digitization_;
  std::vector<std::filesystem::path> repeated_, scans_;  // named again, and each once
  std::vector<std::string> names_;
  std::optional<catalog::ShapeCatalog> catalog_;  // none if every scan is missing
  BatchProgress progress_;
  std::map<std::string, shape_pipeline::ScanTruth> truths_;
  std::vector<DigitizedScan> outcomes_;
};

/// A heading and a line for each bad scan with its name and the first of its reasons; empty if there is none.
std::string failures_text(const std::vector<DigitizedScan>& outcomes);

/// The same for the shapes with checks that did not pass.
std::string failed_checks_text(const std::vector<DigitizedScan>& outcomes);

}  // namespace workflows
