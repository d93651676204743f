// SPDX-License-Identifier: GPL-3.0-or-later
// talus-decompose: convex parts at several levels of detail for the shapes of a catalogue.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "catalog/input_error.h"
#include "workflows/command_options.h"
#include "workflows/decompose_batch.h"
#ifdef TALUS_WITH_DIGITIZE
#include "workflows/digitize_batch.h"
#endif
#include "workflows/stage_tool.h"
#include "workflows/thread_count.h"

namespace {

using namespace workflows;

struct CommandLine {
  std::vector<std::filesystem::path> inputs;
  std::string into, unit;  // of scans
  std::optional<int> genus;
  std::optional<catalog::SeparateBodies> bodies;
  DecomposeBatchOptions batch;
  std::optional<double> effort;
  bool json = false;
};

std::string face_range() {
  return std::to_string(decomposition::kFewestFaces) + " to " + std::to_string(decomposition::kMostFaces);
}

int face_cap(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || (value != 0 && (value < decomposition::kFewestFaces || value > decomposition::kMostFaces)))
    throw CLI::ValidationError("--faces", "expected " + face_range() + " faces, or 0 for no cap, found '" + text + "'");
  return value;
}

void declare_options(CLI::App& app, CommandLine& line) {
  app.name("talus decompose");
  app.set_version_flag("--version", tool_version());
  decomposition::DecompositionOptions& quality = line.batch.quality;
  app.add_option("INPUT", line.inputs,
                 "the catalogue, for example ore.talus; or, with --into, scans and folders of them")
      ->required();
  app.add_option("--into", line.into, "digitise the scans into this catalogue first, as talus digitize would");
  app.add_option("--unit", line.unit, "with --into: length unit of the scans, such as mm");
  app.add_option("--genus", line.genus,
                 "with --into: handles of each particle, 0 (if not given) for a stone, 1 for a ring")
      ->check(CLI::Range(0, 100));
  add_number_list(app, "--parts", line.batch.part_counts, {1, catalog::kMostParts},
                  "levels: most convex parts of each, 1 to " + std::to_string(catalog::kMostParts));
  add_number_list(
      app, "--vertices", line.batch.vertex_caps, {decomposition::kFewestVertices, decomposition::kMostVertices},
      "most vertices a part, " + std::to_string(decomposition::kFewestVertices) + " to " +
          std::to_string(decomposition::kMostVertices) + "; several, such as 16,32,64, make a ladder of each");
  app.add_option_function<std::string>(
         "--faces", [&quality](const std::string& text) { quality.face_cap = face_cap(text); },
         "most faces a part, faces in one plane counted as one, " + face_range() + "; 0 (if not given): no cap")
      ->type_name("N");
  add_word(
      app, "--mode", catalog::mode_names(),
      [&](std::size_t mode) { quality.mode = static_cast<catalog::FitMode>(mode); },
      "volume-true (if not given; the mesh's volume), enclosing (nothing missing; bodies in a fill weigh what the "
      "level's larger volume weighs) or inscribed (nothing sticks out; they weigh less)");
  add_word(
      app, "--bodies", catalog::separate_bodies_names(),
      [&](std::size_t k) { line.bodies = static_cast<catalog::SeparateBodies>(k); },
      "of a mesh of several bodies: join them in one grain (if not given), keep the largest, or refuse; with --into "
      "also as talus digitize has it, which refuses scans of several if it is not given");
  add_number(app, "--time-budget", quality.time_budget, {0, 1e6},
             "CPU seconds a shape, shared by its caps of vertices: searches of growing effort, the best kept, so that "
             "more time is never worse; how many depends on the machine; 0: one search of --effort");
  add_number(app, "--smallest-thickness", quality.smallest_thickness, {0, 1, true},
             "of a part, as a share of that of the shape (of several bodies the thickest)");
  add_number(app, "--smallest-volume", quality.smallest_volume, {0, 1, true},
             "of a part, as a share of that of the shape (of several bodies the largest)");
  add_seed(app, "--seed", quality.seed, "of the random numbers; the same seed gives the same bytes");
  add_number(app, "--effort", line.effort, 1, {decomposition::kLeastEffort, decomposition::kMostEffort},
             "more looks for better cuts, time in proportion; not with --time-budget");
  app.add_option("--threads", quality.threads, "0: as many as the machine has")->check(CLI::Range(0, kMostThreads));
  app.add_option("--select", line.batch.select, "only the shapes of this query, see talus catalog query --help");
  app.add_flag("--json", line.json, "one JSON object instead of a table; ratios, not per cent");
}

/// What became of the scans of the command line.
struct Scans {
  std::vector<std::string> names;  // in the catalogue
  std::vector<DecomposeBatchResult::Failure> failures;
  std::string failed_checks;  // of the shapes stored, see failed_checks_text()
};

#ifdef TALUS_WITH_DIGITIZE
Scans digitized(const CommandLine& line) {
  DigitizeBatchOptions options;
  options.inputs = line.inputs;
  options.catalog_path = line.into;
  options.settings.unit = line.unit;
  options.settings.genus = line.genus.value_or(0);
  if (line.bodies) options.settings.bodies = *line.bodies;
  DigitizeBatch batch(options);
  batch.run();
  Scans scans;
  for (const DigitizedScan& outcome : batch.outcomes())
    if (outcome.is_bad())
      scans.failures.push_back({outcome.name, outcome.reason, std::nullopt});
    else
      scans.names.push_back(outcome.name);
  scans.failed_checks = failed_checks_text(batch.outcomes());
  return scans;
}
#else
Scans digitized(const CommandLine&) {
  throw catalog::UsageError("--into: this build cannot digitise scans; make a catalogue with one that can");
}
#endif

/// By its ending, also where this build reads no scans.
bool looks_like_a_scan(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::vector<std::string> endings{".stl", ".obj", ".off", ".ply",  ".tab",  ".pcd",  ".xyz", ".pwn",
                                         ".txt", ".asc", ".tif", ".tiff", ".nrrd", ".nhdr", ".raw"};
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// A catalogue that is there; opening for writing would make a new one.
catalog::ShapeCatalog open_existing(const std::string& path) {
  if (std::filesystem::is_directory(path))
    throw catalog::InputError(path +
                              ": is a folder, expected a catalogue; to decompose the scans in it say where the "
                              "shapes go and in which unit they are: --into ore.talus --unit mm");
  if (looks_like_a_scan(path))
    throw catalog::InputError(path + ": has the ending of a scan, expected a catalogue; make one with talus digitize " +
                              path +
                              " --unit mm --into ore.talus, or decompose it at once: add --into ore.talus --unit mm");
  if (!std::filesystem::exists(path))
    throw catalog::InputError(path + ": no such catalogue; make one with talus digitize ... --into " + path);
  if (std::filesystem::is_regular_file(path) && std::filesystem::file_size(path) == 0)
    throw catalog::InputError(path +
                              ": is an empty file, expected a catalogue; make one with talus digitize ... --into");
  return {path, catalog::ShapeCatalog::Access::read_write};
}

/// Options that exclude one another, or fit one way of naming the input only.
void check_inputs(const CommandLine& line) {
  if (line.effort && line.batch.quality.time_budget > 0)
    throw catalog::UsageError("--effort and --time-budget: a time budget finds the effort by itself; give one of them");
  if (line.into.empty() && line.inputs.size() != 1)
    throw catalog::UsageError(std::to_string(line.inputs.size()) +
                              " inputs, expected one catalogue; scans need --into ore.talus");
  if (line.into.empty() && !line.unit.empty()) throw catalog::UsageError("--unit is for scans; add --into ore.talus");
  if (line.into.empty() && line.genus) throw catalog::UsageError("--genus is for scans; add --into ore.talus");
  if (!line.into.empty() && !line.batch.select.empty())
    throw catalog::UsageError("--select is for the shapes of a catalogue; name the scans instead");
}

DecomposeBatchResult decompose_with_progress(const DecomposeBatchOptions& options) {
  catalog::ShapeCatalog shapes = open_existing(options.catalog);
  std::unique_ptr<BatchProgress> progress;
  DecomposeBatchResult result = decompose_shapes(shapes, options, [&](const std::string& name, std::size_t of) {
    if (!progress) progress = std::make_unique<BatchProgress>("decompose", static_cast<int>(of));
    progress->step(name);
  });
  if (progress) progress->finish();
  return result;
}

int decompose_all(CommandLine line) {
  check_inputs(line);
  if (line.effort) line.batch.quality.effort = *line.effort;
  if (line.bodies) line.batch.quality.bodies = *line.bodies;
  DecomposeBatchResult result;
  std::string failed_checks;
  if (line.into.empty()) {
    line.batch.catalog = line.inputs.front().string();
    result = decompose_with_progress(line.batch);
  } else {
    Scans scans = digitized(line);
    line.batch.catalog = line.into;
    line.batch.names = std::move(scans.names);
    failed_checks = std::move(scans.failed_checks);
    if (!line.batch.names.empty()) result = decompose_with_progress(line.batch);
    result.failures.insert(result.failures.begin(), scans.failures.begin(), scans.failures.end());
  }
  const std::string text = line.json ? batch_json(result) : batch_text(result);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("stdout cannot be written");
  for (const auto& failure : result.failures)
    std::fprintf(stderr, "talus decompose: %s\n", failure_text(failure).c_str());
  if (!failed_checks.empty()) std::fprintf(stderr, "talus decompose: %s", failed_checks.c_str());
  if (!result.failures.empty()) return kBadInput;
  return failed_checks.empty() ? kDone : kCheckNotPassed;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  CLI::App app(
      "Example: talus decompose ore.talus --parts 1,2,4,8 --vertices 32\n         talus decompose scans/ --into "
      "ore.talus "
      "--unit mm\nDivides every shape that lacks these levels into convex parts and prints their measured errors. A "
      "scan, shape or level that cannot be used or made is listed at the end, with its reason; the exit status is then "
      "3, else 4 if a "
      "shape that was digitised has a check that did not pass.");
  declare_options(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return ended_status(app, error);
  }
  return run_stage("decompose", [&] { return decompose_all(line); });
}
