// SPDX-License-Identifier: Apache-2.0
// talus-catalog: looks into a shape catalogue; never changes it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "catalog/shape_catalog.h"
#include "workflows/atomic_file.h"
#include "workflows/catalog_listing.h"
#include "workflows/command_options.h"
#include "workflows/level_choice.h"
#include "workflows/mesh_export.h"
#include "workflows/population/comparison_report.h"
#include "workflows/population/form_table.h"
#include "workflows/shape_sampling.h"
#include "workflows/stage_tool.h"

namespace {

using namespace workflows;
using catalog::InputError;
using catalog::ShapeCatalog;
using catalog::ShapeId;
using catalog::ShapeSummary;

struct CatalogOptions {
  std::string action;
  std::string catalog;
  std::string name;        // show, export
  std::string expression;  // query, sample, list
  std::string weight;      // sample: a descriptor or column; empty for equal probability
  std::size_t count = 1;
  std::uint64_t seed = 1;
  std::string stl, ply, off;  // export
  int level = 0;              // export: parts asked; 0 for the mesh
  int vertex_cap = 0;         // export: 0 for the largest there is
  int face_cap = 0;           // export: 0 for a level without one
  catalog::FitMode mode = catalog::FitMode::volume_true;
  std::string reference, reference_select, plot;  // compare
  bool json = false;
};

void declare_options(CLI::App& app, CatalogOptions& options) {
  app.name("talus catalog");
  app.require_subcommand(1);
  app.set_version_flag("--version", tool_version());
  const auto action = [&](const std::string& name, const std::string& help) {
    CLI::App* sub = app.add_subcommand(name, help);
    sub->add_option("CATALOG", options.catalog, "the catalogue, for example ore.talus")->required();
    sub->add_flag("--json", options.json, "one JSON object instead of text, SI units");
    return sub;
  };
  CLI::App* list = action(
      "list",
      "Example: talus catalog list ore.talus\nOne line a shape: size, faces, descriptors, levels, failed checks.");
  list->add_option("--select", options.expression, "only the shapes of this query");
  CLI::App* show = action("show", "Example: talus catalog show ore.talus rock_7\nEverything kept of one shape.");
  show->add_option("NAME", options.name, "the shape")->required();
  CLI::App* query = action("query",
                           "Example: talus catalog query ore.talus 'sphericity_wadell > 0.7 and name like "
                           "\"rock%\"'\nNames of the shapes that an expression selects.");
  query
      ->add_option("EXPR", options.expression,
                   "and, or, not, ( ), < <= > >= = !=, like, in over name, grade (1 best to 3), volume [m3], "
                   "face_count, vertex_count, "
                   "failed_checks, level_count, source_file and any descriptor")
      ->required();
  CLI::App* sample =
      action("sample",
             "Example: talus catalog sample ore.talus --count 100 --seed 7 --select 'failed_checks = 0'\nNames drawn "
             "at random with replacement; the same seed gives the same names everywhere.");
  sample->add_option("--count", options.count, "how many")->required()->check(CLI::Range(1, 100'000'000));
  add_seed(*sample, "--seed", options.seed, "of the random numbers");
  sample->add_option("--select", options.expression, "draw from the shapes of this query");
  sample->add_option("--weight", options.weight,
                     "probability in proportion to volume, face_count or a descriptor; equal if not given");
  CLI::App* write = action("export",
                           "Example: talus catalog export ore.talus rock_7 --stl rock_7.stl --level 4\nThe mesh, or "
                           "the convex parts of a level, as files in metres.");
  write->add_option("NAME", options.name, "the shape")->required();
  write->add_option("--stl", options.stl, "binary STL (float32)");
  write->add_option("--ply", options.ply, "binary PLY (float64, part numbers)");
  write->add_option("--off", options.off, "OFF text (exact)");
  write->add_option("--level", options.level, "parts asked for: 1, 2, 4, ...; the mesh if not given")
      ->check(CLI::Range(1, 1000000));
  write->add_option("--vertex-cap", options.vertex_cap, "of the level; the largest if not given")
      ->check(CLI::Range(1, 1000000));
  write->add_option("--face-cap", options.face_cap, "of the level; one without a cap if not given")
      ->check(CLI::Range(0, 1000000));
  add_word(
      *write, "--mode", catalog::mode_names(),
      [&](std::size_t mode) { options.mode = static_cast<catalog::FitMode>(mode); },
      "of the level: volume-true (if not given), enclosing or inscribed");
  CLI::App* compare =
      action("compare",
             "Example: talus catalog compare ore.talus --reference sand.csv --plot sand.svg\nDistributions of size and "
             "form of the shapes beside those of other grains: means, standard deviations, percentiles, correlations, "
             "Kolmogorov-Smirnov distances, Zingg's classes.");
  compare->add_option("--reference", options.reference, "CSV file of descriptors (Sand Atlas), or a catalogue")
      ->required();
  compare->add_option("--select", options.expression, "only the shapes of this query");
  compare->add_option("--reference-select", options.reference_select, "of a catalogue as reference, the same");
  compare->add_option("--plot", options.plot, "SVG file of the cumulative distributions");
  action("rejected", "Example: talus catalog rejected ore.talus\nInputs that could not be used, with the reason.");
}

ShapeId id_of(const ShapeCatalog& catalog, const CatalogOptions& options) {
  if (const auto id = catalog.find(options.name)) return *id;
  std::vector<std::string> names;
  for (const ShapeId id : catalog.select("")) names.push_back(catalog.summary(id).name);
  for (const auto& rejected : catalog.rejected())
    if (rejected.name == options.name)
      throw InputError(options.catalog + ": " + options.name + " was rejected: " + rejected.reason);
  const auto nearest = catalog::nearest_word(options.name, names);
  throw InputError(options.catalog + ": has no shape '" + options.name + "'; " +
                   (names.empty() ? "it is empty: fill it with talus digitize ... --into"
                                  : (nearest ? "did you mean '" + *nearest + "'? " : std::string()) +
                                        "See talus catalog list " + options.catalog));
}

std::vector<ShapeSummary> selected(const ShapeCatalog& catalog, const std::string& expression) {
  std::vector<ShapeSummary> shapes;
  for (const ShapeId id : catalog.select(expression)) shapes.push_back(catalog.summary(id));
  return shapes;
}

double weight_of(const ShapeSummary& shape, const std::string& word) {
  if (word.empty()) return 1;
  if (word == "volume") return shape.volume;
  if (word == "face_count") return static_cast<double>(shape.face_count);
  const auto found = shape.descriptors.find(word);
  if (found != shape.descriptors.end()) return found->second;
  std::vector<std::string> known{"volume", "face_count"};
  for (const auto& [name, value] : shape.descriptors) known.push_back(name);
  throw InputError("--weight " + word + ": " + shape.name + " has no such figure; " + catalog::word_hint(word, known));
}

std::vector<ShapeSummary> sampled(const ShapeCatalog& catalog, const CatalogOptions& options) {
  const std::vector<ShapeSummary> shapes = selected(catalog, options.expression);
  if (shapes.empty())
    throw InputError(options.catalog + ": --select \"" + options.expression +
                     "\" selects no shape; expected at least one");
  std::vector<double> weights;
  for (const ShapeSummary& shape : shapes) {
    weights.push_back(weight_of(shape, options.weight));
    if (!(weights.back() >= 0) || std::isinf(weights.back()))
      throw InputError("--weight " + options.weight + ": is negative or not a number for " + shape.name +
                       "; expected figures of at least 0; leave that shape out with --select");
  }
  if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0; }))
    throw InputError("--weight " + options.weight + ": is 0 for every shape; expected one above 0");
  std::vector<ShapeSummary> drawn;
  for (const std::size_t index : draw(weights, options.count, options.seed)) drawn.push_back(shapes[index]);
  return drawn;
}

/// The level asked for; without a cap of vertices the one with the largest that the shape has.
catalog::LevelKey level_key(const ShapeSummary& shape, const CatalogOptions& options) {
  catalog::LevelKey key{options.level, options.vertex_cap, options.face_cap, options.mode};
  if (key.vertex_cap > 0) return key;
  for (const auto& level : shape.levels)
    if (level.key.parts_asked == key.parts_asked && level.key.face_cap == key.face_cap && level.key.mode == key.mode)
      key.vertex_cap = std::max(key.vertex_cap, level.key.vertex_cap);
  if (key.vertex_cap == 0)
    throw InputError(
        "--level " + std::to_string(options.level) + ": " + shape.name + " has no such level; " +
        (shape.levels.empty() ? "it has none, run talus decompose first" : "it has " + listed(shape.levels)));
  return key;
}

ExportMesh export_mesh(const ShapeCatalog& catalog, const CatalogOptions& options) {
  const ShapeId id = id_of(catalog, options);
  if (options.level == 0) return {catalog.shape(id).mesh, {}};
  return joined(catalog.level(id, level_key(catalog.summary(id), options)).parts);
}

void export_files(const ShapeCatalog& catalog, const CatalogOptions& options) {
  if (options.stl.empty() && options.ply.empty() && options.off.empty())
    throw catalog::UsageError("export needs a file: --stl FILE, --ply FILE or --off FILE");
  const bool has_limits =
      options.vertex_cap != 0 || options.face_cap != 0 || options.mode != catalog::FitMode::volume_true;
  if (has_limits && options.level == 0)
    throw catalog::UsageError("--vertex-cap, --face-cap and --mode go with --level");
  const ExportMesh shape = export_mesh(catalog, options);
  if (!options.stl.empty()) write_file(options.stl, stl_bytes(shape));
  if (!options.ply.empty()) write_file(options.ply, ply_bytes(shape));
  if (!options.off.empty()) write_file(options.off, off_bytes(shape));
}

std::string names_text(const std::vector<ShapeSummary>& shapes) {
  std::string text;
  for (const ShapeSummary& shape : shapes) text += shape.name + "\n";
  return text;
}

std::string compared(const ShapeCatalog& catalog, const CatalogOptions& options) {
  if (!options.plot.empty()) require_own_place(options.plot, "--plot", "<svg");
  const FormTable reference = read_form_table(options.reference, options.reference_select);
  const FormTable made = form_table(catalog, options.expression, options.catalog);
  const auto comparison = compare_populations(reference.rows, made.rows, Samples::independent);
  if (!options.plot.empty())
    write_whole(options.plot, distributions_svg({reference.source, reference.rows}, {made.source, made.rows}));
  return options.json ? comparison_json(comparison, reference.source, made.source) + "\n"
                      : comparison_text(comparison, reference.source, made.source);
}

/// What goes to stdout.
std::string answer(const CatalogOptions& options) {
  const ShapeCatalog catalog(options.catalog, ShapeCatalog::Access::read_only);
  if (options.action == "list") {
    const auto shapes = selected(catalog, options.expression);
    return options.json ? list_json(shapes) : list_text(shapes);
  }
  if (options.action == "compare") return compared(catalog, options);
  if (options.action == "show") {
    const ShapeId id = id_of(catalog, options);
    const auto print = options.json ? show_json : show_text;
    return print(catalog.shape(id), catalog.summary(id));
  }
  if (options.action == "rejected")
    return options.json ? rejected_json(catalog.rejected()) : rejected_text(catalog.rejected());
  if (options.action == "export") {
    export_files(catalog, options);
    return options.json ? names_json({catalog.summary(*catalog.find(options.name))}) : "";
  }
  const auto shapes = options.action == "sample" ? sampled(catalog, options) : selected(catalog, options.expression);
  return options.json ? names_json(shapes) : names_text(shapes);
}

}  // namespace

int main(int argc, char** argv) {
  CatalogOptions options;
  CLI::App app("Example: talus catalog list ore.talus\nLooks into a shape catalogue.");
  declare_options(app, options);
  try {
    app.parse(argc, argv);
    options.action = app.get_subcommands().front()->get_name();
  } catch (const CLI::ParseError& error) {
    return ended_status(app, error);
  }
  return run_stage("catalog", [&] {
    const std::string text = answer(options);
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
      throw std::runtime_error("stdout cannot be written");
    return kDone;
  });
}
