// SPDX-License-Identifier: GPL-3.0-or-later
// talus-decompose: convex parts at several levels of detail for the shapes of a catalogue.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>

#include "catalog/input_error.h"
#include "workflows/decompose_batch.h"
#include "workflows/stage_tool.h"

namespace {

using namespace workflows;

struct CommandLine {
  std::string catalog;
  DecomposeBatchOptions batch;
  bool json = false;
};

void declare_options(CLI::App& app, CommandLine& line) {
  app.name("talus decompose");
  app.set_version_flag("--version", tool_version());
  decomposition::DecompositionOptions& quality = line.batch.quality;
  app.add_option("CATALOG", line.catalog, "the catalogue, for example ore.talus")->required();
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
  app.add_option("--time-budget", quality.time_budget,
                 "CPU seconds a shape for looking for cuts; the result then depends on the machine; 0: by --effort")
      ->check(CLI::Range(0.0, 1e6));
  app.add_option("--seed", quality.seed, "of the random numbers; the same seed gives the same bytes")
      ->capture_default_str();
  app.add_option("--effort", quality.effort, "more looks for better cuts, time in proportion")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  app.add_option("--threads", quality.threads, "0: as many as the machine has")->check(CLI::Range(0, 1024));
  app.add_option("--select", line.batch.select, "only the shapes of this query, see talus catalog query --help");
  app.add_flag("--json", line.json, "one JSON object instead of a table; ratios, not per cent");
}

/// A catalogue that is there; opening for writing would make a new one.
catalog::ShapeCatalog open_existing(const std::string& path) {
  if (!std::filesystem::exists(path))
    throw catalog::InputError(path + ": no such catalogue; make one with talus digitize ... --into " + path);
  if (std::filesystem::is_regular_file(path) && std::filesystem::file_size(path) == 0)
    throw catalog::InputError(path +
                              ": is an empty file, expected a catalogue; make one with talus digitize ... --into");
  return {path, catalog::ShapeCatalog::Access::read_write};
}

int decompose_all(const CommandLine& line) {
  catalog::ShapeCatalog shapes = open_existing(line.catalog);
  std::unique_ptr<BatchProgress> progress;
  const DecomposeBatchResult result =
      decompose_shapes(shapes, line.batch, [&](const std::string& name, std::size_t of) {
        if (!progress) progress = std::make_unique<BatchProgress>("decompose", static_cast<int>(of));
        progress->step(name);
      });
  progress->finish();
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
      "Example: talus decompose ore.talus --parts 1,2,4,8 --vertices 32\nDivides every shape that lacks these levels "
      "into convex parts and prints their measured errors.");
  declare_options(app, line);
  try {
    app.parse(argc, argv);
    line.batch.catalog = line.catalog;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  }
  return run_stage("decompose", [&] { return decompose_all(line); });
}
