// SPDX-License-Identifier: GPL-3.0-or-later
// talus-digitize: scans to shapes in the catalogue.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "catalog/input_error.h"
#include "catalog/shape_catalog.h"
#include "shape_pipeline/digitization.h"
#include "shape_pipeline/scan_file.h"
#include "shape_pipeline/virtual_scan.h"
#include "workflows/stage_tool.h"
#include "workflows/units.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using shape_pipeline::DigitizationOptions;
using shape_pipeline::ReconstructionMethod;
using shape_pipeline::RemeshingStyle;
using shape_pipeline::ScanTruth;

/// The command line as typed.
struct CommandLine {
  std::vector<fs::path> inputs;
  fs::path catalog_path, truth_path, virtual_scan_folder;
  std::string unit, size, name, method = "auto";
  int genus = 0, faces = 10000, count = 4, points = 6000;
  std::uint64_t seed = 1;
  std::string noise = "0.03 mm";
  double gap_degrees = 20;
  bool is_isotropic = false, drops_nan = false, is_json = false;
};

constexpr char kDescription[] =
    "Example: talus digitize scans/ rock.stl --into ore.talus --unit mm\n\n"
    "Turns point clouds (PLY, PCD, XYZ) and meshes (STL, OBJ, PLY, OFF, planetary TAB) into watertight meshes with\n"
    "descriptors and stores them in a catalogue. A folder stands for the scan files in it. A scan that is in the\n"
    "catalogue already, from the same bytes with the same options, is skipped. A bad scan is kept as rejected with "
    "its\n"
    "reason, and the batch goes on; the exit status is then 3.\n\n"
    "  talus digitize --make-virtual-scans scans/ --count 4 --seed 1\n\n"
    "writes scans of generated rocks with noise and gaps, and their truth (use --unit m --truth scans/truth.json).";

void declare_options(CLI::App& app, CommandLine& line) {
  app.add_option("INPUT", line.inputs, "scan files, or folders of them");
  app.add_option("--into", line.catalog_path, "catalogue file; made if it is missing");
  app.add_option("--unit", line.unit, "length unit of the scans: " + accepted_units(Dimension::length));
  app.add_option("--genus", line.genus, "handles of the particle: 0 for a stone, 1 for a ring")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  app.add_option("--faces", line.faces, "largest number of faces kept")
      ->check(CLI::Range(100, 10000000))
      ->capture_default_str();
  app.add_flag("--isotropic", line.is_isotropic, "remesh to about --faces nearly equilateral faces");
  app.add_option("--size", line.size, "rescale so that the intermediate (sieve) axis has this length, such as '30 mm'");
  app.add_option("--name", line.name, "name in the catalogue (one input); else the file's name without ending");
  app.add_option("--method", line.method, "auto, poisson or alpha-wrap")
      ->check(CLI::IsMember({"auto", "poisson", "alpha-wrap"}))
      ->capture_default_str();
  app.add_flag("--drop-nan", line.drops_nan, "drop points that are no numbers instead of refusing the cloud");
  app.add_option("--truth", line.truth_path,
                 "JSON of known volumes and areas: checks the error of each scan named in it");
  app.add_flag("--json", line.is_json, "one JSON object a scan on stdout");
  app.add_option("--make-virtual-scans", line.virtual_scan_folder, "write virtual scans into this folder and stop");
  app.add_option("--count", line.count, "virtual scans")->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_option("--seed", line.seed, "seed of the virtual scans")->capture_default_str();
  app.add_option("--points", line.points, "points of a virtual scan")
      ->check(CLI::Range(100, 10000000))
      ->capture_default_str();
  app.add_option("--noise", line.noise, "standard deviation of a virtual scan's points")->capture_default_str();
  app.add_option("--gap", line.gap_degrees, "half angle of the cap missing from a virtual scan [deg]")
      ->check(CLI::Range(0.0, 90.0))
      ->capture_default_str();
}

DigitizationOptions checked_options(const CommandLine& line) {
  if (line.inputs.empty())
    throw catalog::UsageError("no scan named; give files or folders, or --make-virtual-scans DIR");
  if (line.catalog_path.empty()) throw catalog::UsageError("no catalogue named; add --into ore.talus");
  if (line.unit.empty())
    throw catalog::InputError("--unit: scans carry no unit and none is guessed; state it, such as --unit mm (one of " +
                              accepted_units(Dimension::length) + ")");
  const std::optional<double> unit = length_unit(line.unit);
  if (!unit)
    throw catalog::InputError("--unit: expected one of " + accepted_units(Dimension::length) + ", found '" + line.unit +
                              "'; state the unit of the scans' coordinates");
  DigitizationOptions options;
  options.metres_per_unit = *unit;
  options.drops_nan_points = line.drops_nan;
  options.reconstruction.genus = line.genus;
  if (line.method == "poisson") options.reconstruction.method = ReconstructionMethod::poisson;
  if (line.method == "alpha-wrap") options.reconstruction.method = ReconstructionMethod::alpha_wrap;
  options.remeshing.face_limit = static_cast<std::size_t>(line.faces);
  if (line.is_isotropic) options.remeshing.style = RemeshingStyle::isotropic;
  if (!line.size.empty()) {
    options.sieve_size = parse_quantity(line.size, Dimension::length);
    if (!options.sieve_size || !(*options.sieve_size > 0))
      throw catalog::InputError("--size: expected a length above 0 such as '30 mm', found '" + line.size + "'");
  }
  return options;
}

/// Everything that changes the result, as JSON; part of the test whether a scan is done already.
std::string options_text(const CommandLine& line, const std::optional<ScanTruth>& truth) {
  nlohmann::ordered_json options{{"unit", line.unit},
                                 {"genus", line.genus},
                                 {"faces", line.faces},
                                 {"remeshing", line.is_isotropic ? "isotropic" : "edge_collapse"},
                                 {"method", line.method}};
  if (line.drops_nan) options["drop_nan"] = true;
  if (!line.size.empty()) options["size"] = line.size;
  if (truth) options["truth"] = {{"volume", truth->volume}, {"surface_area", truth->surface_area}};
  return options.dump();
}

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

struct Outcome {
  std::string name, status;  // "stored", "skipped", "rejected" or "missing"
  std::string reason;        // of "rejected" and "missing"
  catalog::ShapeSummary summary;

  bool is_bad() const { return status == "rejected" || status == "missing"; }
};

/// The catalogue to fill; SQLite takes an empty file for a new database, but it may be anything of the user's.
catalog::ShapeCatalog open_catalog(const fs::path& path) {
  if (fs::is_regular_file(path) && fs::file_size(path) == 0)
    throw catalog::InputError(
        path.string() + ": is an empty file, expected a catalogue or a new name; delete the file or name another");
  return {path, catalog::ShapeCatalog::Access::read_write};
}

/// A file that is there but may not be looked at is not missing.
bool is_missing(const fs::path& scan) {
  std::error_code error;
  return fs::status(scan, error).type() == fs::file_type::not_found;
}

/// A reason up to its first semicolon, without the file's name before it.
std::string first_reason(const Outcome& outcome, const fs::path& scan) {
  std::string text = outcome.reason;
  const std::string prefix = scan.string() + ": ";
  if (text.starts_with(prefix)) text.erase(0, prefix.size());
  text.resize(std::min(text.size(), text.find("; ")));
  if (std::count(text.begin(), text.end(), '(') > std::count(text.begin(), text.end(), ')')) text += ')';
  return text;
}

class Batch {
 public:
  Batch(const CommandLine& line, const DigitizationOptions& options)
      : line_(line),
        options_(options),
        scans_(shape_pipeline::scan_files(line.inputs)),
        names_(shape_names(scans_, line.name)),
        progress_("digitize", static_cast<int>(scans_.size())) {
    if (!line.truth_path.empty()) truths_ = shape_pipeline::read_truth(line.truth_path);
    // Without a scan to read no catalogue is made.
    if (std::any_of(scans_.begin(), scans_.end(), [](const fs::path& scan) { return !is_missing(scan); }))
      catalog_.emplace(open_catalog(line.catalog_path));
  }

  void run() {
    for (std::size_t s = 0; s < scans_.size(); ++s) {
      progress_.step(scans_[s].filename().string());
      outcomes_.push_back(process(scans_[s], names_[s]));
    }
    progress_.finish();
  }

  /// Of the scans done, in the order of the scans.
  const std::vector<Outcome>& outcomes() const { return outcomes_; }
  const fs::path& scan(std::size_t s) const { return scans_[s]; }

 private:
  /// Errors of the scan make an outcome; errors of the catalogue, such as a lock, are not the scan's and end the batch.
  Outcome process(const fs::path& scan, const std::string& name) {
    if (is_missing(scan)) {
      const std::string reason = scan.string() + ": no such file; check the path";
      progress_.note(reason);
      return {name, "missing", reason, {}};
    }
    catalog::Provenance provenance{scan.filename().string(), "", tool_version(), ""};
    const auto known = truths_.find(scan.filename().string());
    const auto truth = known == truths_.end() ? std::nullopt : std::optional(known->second);
    provenance.options = options_text(line_, truth);
    if (const std::string reason = refusal(scan, [&] { provenance.source_sha256 = catalog::sha256_of_file(scan); });
        !reason.empty())
      return rejected(name, provenance, reason);
    if (const auto id = catalog_->find(name); id && is_same(catalog_->shape(*id).provenance, provenance)) {
      catalog_->forget_rejected(name);
      return {name, "skipped", "", catalog_->summary(*id)};
    }
    catalog::ShapeRecord shape;
    if (const std::string reason = refusal(scan, [&] { shape = shape_pipeline::digitize(scan, options_, truth); });
        !reason.empty())
      return rejected(name, provenance, reason);
    shape.name = name;
    shape.provenance = provenance;
    return {name, "stored", "", catalog_->summary(catalog_->store_shape(shape))};
  }

  /// Why `work` refuses the scan; empty if it does not.
  static std::string refusal(const fs::path& scan, const std::function<void()>& work) {
    try {
      work();
      return "";
    } catch (const catalog::InputError& error) {
      return error.what();
    } catch (const std::logic_error& error) {
      // CGAL reports a geometry it cannot handle this way: this particle is lost, the batch is not.
      return scan.string() + ": the geometry library gave up (" + error.what() + "); clean the scan";
    }
  }

  static bool is_same(const catalog::Provenance& a, const catalog::Provenance& b) {
    return a.source_sha256 == b.source_sha256 && a.options == b.options && a.tool_version == b.tool_version;
  }

  Outcome rejected(const std::string& name, const catalog::Provenance& provenance, const std::string& reason) {
    catalog_->store_rejected({name, provenance.source_file, provenance.source_sha256, reason});
    progress_.note("rejected: " + reason);
    return {name, "rejected", reason, {}};
  }

  const CommandLine& line_;
  const DigitizationOptions& options_;
  std::vector<fs::path> scans_;
  std::vector<std::string> names_;
  std::optional<catalog::ShapeCatalog> catalog_;  // none if every scan is missing
  BatchProgress progress_;
  std::map<std::string, ScanTruth> truths_;
  std::vector<Outcome> outcomes_;
};

void print_json(const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes) {
    nlohmann::ordered_json row{{"name", outcome.name}, {"status", outcome.status}};
    if (outcome.is_bad()) {
      row["reason"] = outcome.reason;
    } else {
      row["descriptors"] = outcome.summary.descriptors;
      row["failed_checks"] = outcome.summary.failed_checks;
    }
    std::printf("%s\n", row.dump().c_str());
  }
}

void print_table(const std::vector<Outcome>& outcomes) {
  std::printf("%-28s %-8s %12s %12s %10s %7s %10s %9s  %s\n", "name", "status", "volume[m3]", "area[m2]", "sieve[m]",
              "faces", "sphericity", "convexity", "checks not passed");
  for (const Outcome& outcome : outcomes) {
    if (outcome.is_bad()) {
      std::printf("%-28s %-8s\n", outcome.name.c_str(), outcome.status.c_str());
      continue;
    }
    const auto value = [&](const char* key) {
      const auto entry = outcome.summary.descriptors.find(key);
      return entry == outcome.summary.descriptors.end() ? 0.0 : entry->second;
    };
    std::string failed;
    for (const std::string& check : outcome.summary.failed_checks) failed += (failed.empty() ? "" : ", ") + check;
    std::printf("%-28s %-8s %12.5g %12.5g %10.4g %7zu %10.4f %9.4f  %s\n", outcome.name.c_str(), outcome.status.c_str(),
                outcome.summary.volume, value("surface_area"), value("sieve_size_second_axis"),
                outcome.summary.face_count, value("sphericity_wadell"), value("convexity_volume_ratio"),
                failed.empty() ? "-" : failed.c_str());
  }
}

int make_virtual_scans(const CommandLine& line) {
  shape_pipeline::VirtualScanSet set;
  set.count = line.count;
  set.seed = line.seed;
  set.flaws.points = line.points;
  set.flaws.gap_angle = *parse_quantity(std::to_string(line.gap_degrees) + " deg", Dimension::angle);
  const std::optional<double> noise = parse_quantity(line.noise, Dimension::length);
  if (!noise || !(*noise >= 0))
    throw catalog::InputError("--noise: expected a length such as '0.03 mm', found '" + line.noise + "'");
  set.flaws.noise_sigma = *noise;
  for (const fs::path& file : shape_pipeline::write_virtual_scans(line.virtual_scan_folder, set))
    std::printf("%s\n", file.string().c_str());
  std::printf("%s\n", (line.virtual_scan_folder / "truth.json").string().c_str());
  return kDone;
}

int digitize_batch(const CommandLine& line) {
  const DigitizationOptions options = checked_options(line);
  Batch batch(line, options);
  const std::vector<Outcome>& outcomes = batch.outcomes();
  const auto print = [&] { line.is_json ? print_json(outcomes) : print_table(outcomes); };
  try {
    batch.run();
  } catch (const std::exception&) {
    print();  // what is done stays done
    std::fflush(stdout);
    throw;
  }
  print();
  const auto bad = std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.is_bad(); });
  if (bad == 0) return kDone;
  std::fprintf(stderr, "digitize: %td of %zu scans rejected or missing:\n", bad, outcomes.size());
  for (std::size_t s = 0; s < outcomes.size(); ++s)
    if (outcomes[s].is_bad())
      std::fprintf(stderr, "  %s: %s\n", outcomes[s].name.c_str(), first_reason(outcomes[s], batch.scan(s)).c_str());
  return kBadInput;
}

}  // namespace
}  // namespace workflows

int main(int argc, char** argv) {
  workflows::CommandLine line;
  CLI::App app(workflows::kDescription, "talus digitize");
  workflows::declare_options(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? workflows::kDone : workflows::kUsage;
  }
  return workflows::run_stage("digitize", [&] {
    return line.virtual_scan_folder.empty() ? workflows::digitize_batch(line) : workflows::make_virtual_scans(line);
  });
}
