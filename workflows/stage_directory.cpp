// SPDX-License-Identifier: Apache-2.0
#include "workflows/stage_directory.h"

#include <unistd.h>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

fs::path path_of(const fs::path& folder, const std::string& stage) { return folder / ("talus-" + stage); }

bool is_built(const fs::path& executable) {
  return fs::is_regular_file(executable) && access(executable.c_str(), X_OK) == 0;
}

}  // namespace

const std::vector<Stage>& stages() {
  static const std::vector<Stage> list{
      {"digitize", "scans (clouds, meshes) to watertight meshes in a catalogue"},
      {"generate", "built-in solids and crushed rocks into a catalogue"},
      {"family", "stretched, rounded, sharpened, smoothed versions of a stored shape"},
      {"compare", "two captures of one particle: aligned, and what differs"},
      {"decompose", "meshes to convex parts at several levels of detail"},
      {"catalog", "list, show, query, sample, export shapes"},
      {"simulate", "run a scene"},
      {"post", "VTK series, curves, pictures, report of a run"},
      {"bench", "speed against error on a named case"},
  };
  return list;
}

std::string front_help(const fs::path& folder) {
  std::string text =
      "Example: talus digitize rock.ply --unit mm --into ore.talus\n"
      "\n"
      "talus STAGE ARGUMENTS...   starts a stage; talus STAGE --help tells its arguments\n"
      "talus --help | --version\n"
      "\n"
      "Stages:\n";
  for (const Stage& stage : stages()) {
    text += "  " + stage.name + std::string(12 - stage.name.size(), ' ') + stage.purpose;
    text += is_built(path_of(folder, stage.name)) ? "\n" : " (not built)\n";
  }
  return text;
}

fs::path stage_executable(const fs::path& folder, const std::string& stage) {
  std::vector<std::string> names;
  for (const Stage& known : stages()) {
    names.push_back(known.name);
    if (known.name != stage) continue;
    const fs::path executable = path_of(folder, stage);
    if (is_built(executable)) return executable;
    throw catalog::UsageError("stage " + stage + " is not built: expected " + executable.string() +
                              "; build it with make build");
  }
  throw catalog::UsageError("unknown stage '" + stage + "'; " + catalog::word_hint(stage, names) + " See talus --help");
}

}  // namespace workflows
