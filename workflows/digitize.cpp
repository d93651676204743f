// SPDX-License-Identifier: GPL-3.0-or-later
// talus-digitize: scans to shapes in the catalogue.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "shape_pipeline/virtual_scan.h"
#include "workflows/cloud_batch.h"
#include "workflows/command_options.h"
#include "workflows/digitize_batch.h"
#include "workflows/micrograph_batch.h"
#include "workflows/stack_batch.h"
#include "workflows/stage_tool.h"
#include "workflows/turntable_batch.h"
#ifdef TALUS_WITH_REPORT
#include "workflows/atomic_file.h"
#include "workflows/digitize_report/digitize_report.h"
#endif
#include "workflows/units.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

/// The command line as typed.
struct CommandLine {
  DigitizeBatchOptions batch;
  CloudSettings cloud;
  StackSettings stack;
  MicrographSettings micrograph;
  TurntableSettings turntable;
  fs::path virtual_scan_folder, report;
  int count = 4, points = 6000;
  std::uint64_t seed = 1;
  std::string noise = "0.03 mm";
  double gap_degrees = 20;
  bool is_json = false;
};

constexpr char kDescription[] =
    "Example: talus digitize scans/ rock.stl --into ore.talus --unit mm\n\n"
    "Turns point clouds (PLY, PCD, XYZ) and meshes (STL, OBJ, PLY, OFF, planetary TAB) into watertight meshes with\n"
    "descriptors and stores them in a catalogue. A folder stands for the scan files in it. A scan that is in the\n"
    "catalogue already, from the same bytes with the same options, is skipped. A bad scan is kept as rejected with "
    "its\n"
    "reason, and the batch goes on; the exit status is then 3. It is 4 if all scans could be used, but a shape has a "
    "check that did\n"
    "not pass: such shapes are stored, and named.\n\n"
    "  talus digitize side1.ply side2.ply side3.ply --register --name rock --into ore.talus --unit mm\n\n"
    "brings partial scans of one particle together. --remove-plane takes the floor or turntable out of a cloud,\n"
    "--separate makes each grain on it a shape of its own, named plate_01, ... from that of most points down.\n\n"
    "  talus digitize stack.tif --into ore.talus --voxel '12 um'\n\n"
    "parts a CT stack (multi-page TIFF, NRRD, RAW with a JSON sidecar, or with --stack a folder of slices) into "
    "its\n"
    "grains, named stack_0001, ... from the largest down.\n\n"
    "  talus digitize image.png --into powder.talus --pixel '0.5 um'\n\n"
    "outlines the grains of a micrograph (PNG, JPEG, BMP, one-page TIFF): tables, outlines and overlay go to\n"
    "powder_outlines/, and a population of solids whose silhouettes match them to the catalogue.\n\n"
    "  talus digitize --turntable views/ --into ore.talus --pixel '20 um'\n\n"
    "takes the images of a folder for the silhouettes of one grain on a turntable and stores its visual hull; a\n"
    "perspective camera, listed angles and the axis go into views/turntable.json.\n\n"
    "  talus digitize --make-virtual-scans scans/ --count 4 --seed 1\n\n"
    "writes scans of generated rocks with noise and gaps, and their truth (use --unit m --truth scans/truth.json).";

constexpr char kNoCatalogue[] = "no catalogue named; add --into ore.talus";

void declare_cloud_options(CLI::App& app, CloudSettings& cloud) {
  app.add_flag("--register", cloud.is_registered, "the clouds are partial scans of one particle");
  app.add_flag("--remove-plane", cloud.removes_plane, "of a cloud: the floor or turntable that it stands on");
  app.add_flag("--separate", cloud.is_separated, "of a cloud: grains that lie apart");
  add_whole_number(app, "--grain-points", cloud.grain_points, {50, 10000000},
                   "of a separated grain, at least; those of fewer are rejected");
}

void declare_stack_options(CLI::App& app, StackSettings& stack) {
  app.add_flag("--stack", stack.is_asked_for, "each folder is one CT stack, a TIFF, PNG, BMP or JPEG a slice");
  app.add_option("--voxel", stack.voxel, "side of a voxel of a stack, such as '12 um'; three for x, y, z with commas");
  app.add_option("--threshold", stack.threshold,
                 "grey value of a stack from which on a voxel is grain; else the one at which volumes are true");
  const std::vector<std::string> filters{"gaussian", "median", "none"};
  add_word(
      app, "--denoise", filters, [&stack, filters](std::size_t k) { stack.denoise = filters[k]; },
      "of a stack: gaussian (if not given), median or none");
  app.add_option("--sigma", stack.sigma, "of that Gaussian [voxels]")
      ->check(CLI::Range(0.1, 5.0))
      ->capture_default_str();
  app.add_option("--neck", stack.neck,
                 "grains of a stack whose neck is wider than this share of the thinner one are one")
      ->check(CLI::Range(0.1, 1.0))
      ->capture_default_str();
  app.add_option("--resolution", stack.resolution, "least voxels a diameter of a grain of a stack")
      ->check(CLI::Range(4.0, 10000.0))
      ->capture_default_str();
  app.add_flag("--keep-cavities", stack.keeps_cavities, "of a stack's grains, as inner surfaces; else they are filled");
}

void declare_micrograph_options(CLI::App& app, MicrographSettings& micrograph) {
  app.add_option("--pixel", micrograph.pixel,
                 "side of a pixel of a micrograph or of turntable images, such as '0.5 um'");
  app.add_option("--scale-bar", micrograph.scale_bar,
                 "what the bar in the data strip of a micrograph stands for, such as '100 um'");
  app.add_flag("--dark-grains", micrograph.has_dark_grains, "of a micrograph, on a bright background");
  app.add_option("--least-diameter", micrograph.least_diameter, "pixels of a micrograph's smallest grain")
      ->check(CLI::Range(3.0, 10000.0))
      ->capture_default_str();
  app.add_option("--out", micrograph.out, "folder for tables of a micrograph; else CATALOGUE_outlines");
  add_whole_number(app, "--population", micrograph.population, {0, 100000},
                   "solids made to look like a micrograph's grains; 0: none");
  app.add_option("--third-axis", micrograph.third_axis,
                 "S/I of these solids, which no micrograph shows: drawn (like I/L) or a ratio")
      ->capture_default_str();
}

void declare_turntable_options(CLI::App& app, TurntableSettings& turntable) {
  app.add_flag("--turntable", turntable.is_asked_for, "each folder is the views of one grain about an axis");
  app.add_option("--cells", turntable.cells, "of the grid along the longest side of a turntable's grain")
      ->check(CLI::Range(20, 400))
      ->capture_default_str();
}

void declare_options(CLI::App& app, CommandLine& line) {
  app.add_option("INPUT", line.batch.inputs, "scan files, or folders of them");
  app.add_option("--into", line.batch.catalog_path, "catalogue file; made if it is missing");
  app.add_option("--unit", line.batch.settings.unit, "length unit of the scans: " + accepted_units(Dimension::length));
  app.add_option("--genus", line.batch.settings.genus, "handles of the particle: 0 for a stone, 1 for a ring")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  add_word(
      app, "--bodies", catalog::separate_bodies_names(),
      [&line](std::size_t k) { line.batch.settings.bodies = static_cast<catalog::SeparateBodies>(k); },
      "of a mesh of several bodies: join them in one grain, keep the largest, or refuse (if not given; pieces of less "
      "than a tenth of the area together are specks, and dropped)");
  app.add_option("--faces", line.batch.settings.faces, "largest number of faces kept")
      ->check(CLI::Range(100, 10000000))
      ->capture_default_str();
  app.add_flag("--isotropic", line.batch.settings.is_isotropic, "remesh to about --faces nearly equilateral faces");
  app.add_option("--size", line.batch.settings.size,
                 "rescale so that the intermediate (sieve) axis has this length, such as '30 mm'");
  app.add_option("--name", line.batch.name, "name in the catalogue (one input); else the file's name without ending");
  const std::vector<std::string> methods{"auto", "poisson", "alpha-wrap"};
  add_word(
      app, "--method", methods, [&line, methods](std::size_t k) { line.batch.settings.method = methods[k]; },
      "auto (if not given), poisson or alpha-wrap");
  app.add_flag("--drop-nan", line.batch.settings.drops_nan,
               "drop points that are no numbers instead of refusing the cloud");
  app.add_option("--truth", line.batch.truth_path,
                 "JSON of known volumes and areas: checks the error of each scan named in it");
  declare_cloud_options(app, line.cloud);
  declare_stack_options(app, line.stack);
  declare_micrograph_options(app, line.micrograph);
  declare_turntable_options(app, line.turntable);
  app.add_flag("--json", line.is_json, "one JSON object a scan on stdout");
#ifdef TALUS_WITH_REPORT
  app.add_option("--report", line.report,
                 "page to write: of each grain the input, the result, a map of its deviation, figures and checks");
#endif
  app.add_option("--make-virtual-scans", line.virtual_scan_folder, "write virtual scans into this folder and stop");
  app.add_option("--count", line.count, "virtual scans")->check(CLI::Range(1, 10000))->capture_default_str();
  add_seed(app, "--seed", line.seed, "seed of the virtual scans, or of a population");
  app.add_option("--points", line.points, "points of a virtual scan")
      ->check(CLI::Range(100, 10000000))
      ->capture_default_str();
  app.add_option("--noise", line.noise, "standard deviation of a virtual scan's points")->capture_default_str();
  app.add_option("--gap", line.gap_degrees, "half angle of the cap missing from a virtual scan [deg]")
      ->check(CLI::Range(0.0, 90.0))
      ->capture_default_str();
}

void print_json(const std::vector<DigitizedScan>& outcomes) {
  for (const DigitizedScan& outcome : outcomes) {
    nlohmann::ordered_json row{{"name", outcome.name}, {"status", outcome.status}};
    if (outcome.is_bad()) {
      row["reason"] = outcome.reason;
    } else {
      row["grade"] = outcome.summary.grade;
      row["descriptors"] = outcome.summary.descriptors;
      row["failed_checks"] = outcome.summary.failed_checks;
    }
    std::printf("%s\n", row.dump().c_str());
  }
}

void print_table(const std::vector<DigitizedScan>& outcomes) {
  std::printf("%-28s %-8s %5s %12s %12s %10s %7s %10s %9s  %s\n", "name", "status", "grade", "volume[m3]", "area[m2]",
              "sieve[m]", "faces", "sphericity", "convexity", "checks not passed");
  for (const DigitizedScan& outcome : outcomes) {
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
    std::printf("%-28s %-8s %5d %12.5g %12.5g %10.4g %7zu %10.4f %9.4f  %s\n", outcome.name.c_str(),
                outcome.status.c_str(), outcome.summary.grade, outcome.summary.volume, value("surface_area"),
                value("sieve_size_second_axis"), outcome.summary.face_count, value("sphericity_wadell"),
                value("convexity_volume_ratio"), failed.empty() ? "-" : failed.c_str());
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
    throw catalog::UsageError("--noise: expected a length such as '0.03 mm', found '" + line.noise + "'");
  set.flaws.noise_sigma = *noise;
  for (const fs::path& file : shape_pipeline::write_virtual_scans(line.virtual_scan_folder, set))
    std::printf("%s\n", file.string().c_str());
  std::printf("%s\n", (line.virtual_scan_folder / "truth.json").string().c_str());
  return kDone;
}

template <class Batch>
void write_report(const CommandLine& line, const Batch& batch) {
#ifdef TALUS_WITH_REPORT
  if (!line.report.empty()) write_whole(line.report, postprocess::digitizing_report_html(report_of(batch)));
#else
  static_cast<void>(line), static_cast<void>(batch);
#endif
}

template <class Batch>
int run_batch(const CommandLine& line, Batch batch) {
  const std::vector<DigitizedScan>& outcomes = batch.outcomes();
  const auto print = [&] { line.is_json ? print_json(outcomes) : print_table(outcomes); };
  try {
    batch.run();
  } catch (const std::exception&) {
    print();  // what is done stays done
    std::fflush(stdout);
    throw;
  }
  print();
  write_report(line, batch);
  const std::string bad = failures_text(outcomes), failed = failed_checks_text(outcomes);
  for (const std::string& text : {bad, failed})
    if (!text.empty()) std::fprintf(stderr, "digitize: %s", text.c_str());
  if (!bad.empty()) return kBadInput;
  return failed.empty() ? kDone : kCheckNotPassed;
}

int digitize_batch(const CommandLine& line) {
#ifdef TALUS_WITH_REPORT
  if (!line.report.empty()) {
    require_own_place(line.report, "--report", "<!DOCTYPE html>");
    if (fs::weakly_canonical(line.report) == fs::weakly_canonical(line.batch.catalog_path))
      throw catalog::InputError(line.report.string() + ": is the catalogue; name another file by --report");
  }
#endif
  if (line.batch.inputs.empty())
    throw catalog::UsageError("no scan named; give files or folders, or --make-virtual-scans DIR");
  if (line.cloud.are_given()) {
    if (line.batch.catalog_path.empty()) throw catalog::UsageError(kNoCatalogue);
    return run_batch(line, CloudBatch(line.batch, line.cloud));
  }
  if (line.turntable.is_asked_for) {
    if (line.stack.is_asked_for) throw catalog::UsageError("--stack and --turntable do not go together");
    if (line.batch.catalog_path.empty()) throw catalog::UsageError(kNoCatalogue);
    TurntableSettings settings = line.turntable;
    settings.pixel = line.micrograph.pixel;
    return run_batch(line, TurntableBatch(line.batch, settings));
  }
  if (are_micrographs(line.batch, line.micrograph)) {
    MicrographSettings settings = line.micrograph;
    settings.seed = line.seed;
    return run_batch(line, MicrographBatch(line.batch, settings));
  }
  if (line.batch.catalog_path.empty()) throw catalog::UsageError(kNoCatalogue);
  if (are_stacks(line.batch, line.stack)) return run_batch(line, StackBatch(line.batch, line.stack));
  return run_batch(line, DigitizeBatch(line.batch));
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
    return workflows::ended_status(app, error);
  }
  return workflows::run_stage("digitize", [&] {
    return line.virtual_scan_folder.empty() ? workflows::digitize_batch(line) : workflows::make_virtual_scans(line);
  });
}
