// SPDX-License-Identifier: GPL-3.0-or-later
// talus-decompose: convex parts at several levels of detail for the shapes of a catalogue.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>

#include "catalog/input_error.h"
#include "workflows/decompose_batch.h"
#ifdef TALUS_WITH_DIGITIZE
#include "workflows/digitize_batch.h"
#endif
#include "workflows/stage_tool.h"

namespace {

using namespace workflows;

struct CommandLine {
  std::vector<std::filesystem::path> inputs;
  std::string into, unit;  // of scans
  int genus = 0;
  DecomposeBatchOptions batch;
  bool json = false;
};

/// A range lets what is not a number through.
CLI::Validator finite_number() {
  return CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        return CLI::detail::lexical_cast(text, value) && std::isfinite(value) ? std::string() : text + " is no number";
      },
      "");
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
  app.add_option("--genus", line.genus, "with --into: handles of each particle, 0 for a stone, 1 for a ring")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  app.add_option("--parts", line.batch.part_counts, "levels: most convex parts of each, 1 to 256")
      ->delimiter(',')
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--vertices", line.batch.vertex_caps,
                 "most vertices a part, 8 to 64; several, such as 16,32,64, make a ladder of each")
      ->delimiter(',')
      ->check(CLI::Range(8, 64))
      ->capture_default_str();
  app.add_option("--faces", quality.face_cap,
                 "most faces a part, faces in one plane counted as one, 8 to 124; 0: no cap")
      ->check(CLI::Range(8, 124) | CLI::IsMember({0}));
  std::map<std::string, catalog::FitMode> modes;
  for (const std::string& name : catalog::mode_names()) modes[name] = *catalog::mode_named(name);
  app.add_option("--mode", quality.mode, "volume-true (the mesh's volume), enclosing (nothing missing), inscribed")
      ->transform(CLI::CheckedTransformer(modes));
  const std::map<std::string, decomposition::SeparateBodies> bodies{{"join", decomposition::SeparateBodies::join},
                                                                    {"largest", decomposition::SeparateBodies::largest},
                                                                    {"refuse", decomposition::SeparateBodies::refuse}};
  app.add_option("--bodies", quality.bodies, "of a mesh of several bodies: join them in one grain, largest, refuse")
      ->transform(CLI::CheckedTransformer(bodies));
  app.add_option("--time-budget", quality.time_budget,
                 "CPU seconds a shape for looking for cuts; the result then depends on the machine; 0: by --effort")
      ->check(finite_number() & CLI::Range(0.0, 1e6));
  app.add_option("--seed", quality.seed, "of the random numbers; the same seed gives the same bytes")
      ->capture_default_str();
  app.add_option("--effort", quality.effort, "more looks for better cuts, time in proportion")
      ->check(finite_number() & CLI::Range(0.1, 100.0))
      ->capture_default_str();
  app.add_option("--threads", quality.threads, "0: as many as the machine has")->check(CLI::Range(0, 1024));
  app.add_option("--select", line.batch.select, "only the shapes of this query, see talus catalog query --help");
  app.add_flag("--json", line.json, "one JSON object instead of a table; ratios, not per cent");
}

/// What became of the scans of the command line.
struct Scans {
  std::vector<std::string> names;  // in the catalogue
  std::vector<DecomposeBatchResult::Failure> failures;
};

#ifdef TALUS_WITH_DIGITIZE
Scans digitized(const CommandLine& line) {
  DigitizeBatchOptions options;
  options.inputs = line.inputs;
  options.catalog_path = line.into;
  options.settings.unit = line.unit;
  options.settings.genus = line.genus;
  DigitizeBatch batch(options);
  batch.run();
  Scans scans;
  for (const DigitizedScan& outcome : batch.outcomes())
    if (outcome.is_bad())
      scans.failures.push_back({outcome.name, outcome.reason});
    else
      scans.names.push_back(outcome.name);
  return scans;
}
#else
Scans digitized(const CommandLine&) {
  throw catalog::UsageError("--into: this build cannot digitise scans; make a catalogue with one that can");
}
#endif

/// A catalogue that is there; opening for writing would make a new one.
catalog::ShapeCatalog open_existing(const std::string& path) {
  if (std::filesystem::is_directory(path))
    throw catalog::InputError(path +
                              ": is a folder, expected a catalogue; to decompose the scans in it say where the "
                              "shapes go and in which unit they are: --into ore.talus --unit mm");
  if (!std::filesystem::exists(path))
    throw catalog::InputError(path + ": no such catalogue; make one with talus digitize ... --into " + path);
  if (std::filesystem::is_regular_file(path) && std::filesystem::file_size(path) == 0)
    throw catalog::InputError(path +
                              ": is an empty file, expected a catalogue; make one with talus digitize ... --into");
  return {path, catalog::ShapeCatalog::Access::read_write};
}

/// Options that fit one way of naming the input only.
void check_inputs(const CommandLine& line) {
  if (line.into.empty() && line.inputs.size() != 1)
    throw catalog::UsageError(std::to_string(line.inputs.size()) +
                              " inputs, expected one catalogue; scans need --into ore.talus");
  if (line.into.empty() && !line.unit.empty()) throw catalog::UsageError("--unit is for scans; add --into ore.talus");
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
  DecomposeBatchResult result;
  if (line.into.empty()) {
    line.batch.catalog = line.inputs.front().string();
    result = decompose_with_progress(line.batch);
  } else {
    Scans scans = digitized(line);
    line.batch.catalog = line.into;
    line.batch.names = std::move(scans.names);
    if (!line.batch.names.empty()) result = decompose_with_progress(line.batch);
    result.failures.insert(result.failures.begin(), scans.failures.begin(), scans.failures.end());
  }
  const std::string text = line.json ? batch_json(result) : batch_text(result);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("stdout cannot be written");
  for (const auto& failure : result.failures)
    std::fprintf(stderr, "talus decompose: %s: not decomposed: %s\n", failure.shape.c_str(), failure.reason.c_str());
  return result.failures.empty() ? kDone : kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  CLI::App app(
      "Example: talus decompose ore.talus --parts 1,2,4,8 --vertices 32\n         talus decompose scans/ --into "
      "ore.talus "
      "--unit mm\nDivides every shape that lacks these levels into convex parts and prints their measured errors. A "
      "scan or shape that cannot be used is listed at the end, with its reason; the exit status is then 3.");
  declare_options(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  }
  return run_stage("decompose", [&] { return decompose_all(line); });
}
