// SPDX-License-Identifier: GPL-3.0-or-later
// talus-generate: built-in solids to shapes in the catalogue.

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "shape_pipeline/built_in_solids.h"
#include "shape_pipeline/described_shape.h"
#include "shape_pipeline/mesh_topology.h"
#include "workflows/command_options.h"
#include "workflows/made_shapes.h"
#include "workflows/stage_tool.h"
#include "workflows/text_format.h"

namespace workflows {
namespace {

using shape_pipeline::SolidRecipe;

struct CommandLine {
  std::string solid;
  std::vector<std::string> parameters;  // "rounding=0.3"
  std::filesystem::path catalog_path;
  std::string size, size_is = "sieve", name;
  std::uint64_t seed = 1;
  int count = 1;
  bool is_json = false, lists_solids = false;
};

constexpr char kDescription[] =
    "Example: talus generate dice rounding=0.2 --into ore.talus --size '12 mm'\n\n"
    "Makes a built-in solid, checks it (closed, Euler number, no self-intersection, volume against its closed form)\n"
    "and stores it in a catalogue. talus generate --list tells the solids and their parameters. The same options\n"
    "give the same bytes; a shape that is there from the same options is skipped.\n\n"
    "  talus generate crushed-rock facets=20 --count 50 --seed 1 --into ore.talus --size '12 mm'\n\n"
    "stores crushed-rock_001 to crushed-rock_050, of the seeds 1 to 50.";

void declare_options(CLI::App& app, CommandLine& line) {
  app.add_option("SOLID", line.solid, "one of --list");
  app.add_option("PARAMETER=VALUE", line.parameters, "parameters of the solid, such as rounding=0.2");
  app.add_flag("--list", line.lists_solids, "list solids and parameters, and stop");
  app.add_option("--into", line.catalog_path, "catalogue file; made if it is missing");
  app.add_option("--size", line.size, "size of the particle, such as '12 mm'");
  const std::vector<std::string> words{"sieve", "volume", "feret"};
  add_word(
      app, "--size-is", words, [&line, words](std::size_t k) { line.size_is = words[k]; },
      "sieve (intermediate axis, if not given), volume (sphere of equal volume) or feret (largest extent)");
  app.add_option("--name", line.name, "name in the catalogue; else the solid's");
  add_seed(app, "--seed", line.seed, "seed of the first crushed rock");
  app.add_option("--count", line.count, "crushed rocks, each of the next seed")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_flag("--json", line.is_json, "one JSON object a shape on stdout");
}

void list_solids() {
  for (const shape_pipeline::SolidKind& kind : shape_pipeline::built_in_solids()) {
    std::printf("%-22s %s\n", kind.name.c_str(), kind.meaning.c_str());
    for (const shape_pipeline::SolidParameter& parameter : kind.parameters)
      std::printf("    %s=%g  (%g to %g) %s\n", parameter.name.c_str(), parameter.usual, parameter.least,
                  parameter.most, parameter.meaning.c_str());
  }
}

SolidRecipe recipe_of(const CommandLine& line) {
  SolidRecipe recipe{line.solid, {}, line.seed};
  for (const std::string& text : line.parameters) {
    const std::size_t sign = text.find('=');
    double value = 0;
    const char* end = text.data() + text.size();
    const bool is_number = sign != std::string::npos && [&] {
      const auto [last, error] = std::from_chars(text.data() + sign + 1, end, value);
      return error == std::errc() && last == end && std::isfinite(value);
    }();
    if (!is_number) throw catalog::InputError("expected PARAMETER=NUMBER such as rounding=0.2, found '" + text + "'");
    recipe.parameters[text.substr(0, sign)] = value;
  }
  return shape_pipeline::complete_recipe(recipe);
}

catalog::ShapeRecord built_shape(const SolidRecipe& recipe, double size, const std::string& size_is) {
  const shape_pipeline::BuiltSolid solid = built_in_solid(recipe);
  catalog::ShapeRecord shape = shape_pipeline::described_shape(
      scaled_to_size(solid.mesh, size, shape_pipeline::size_definition(size_is)), solid.genus);
  if (solid.exact_volume) {
    const double error = shape_pipeline::signed_volume(solid.mesh) / *solid.exact_volume - 1;
    shape.checks.push_back({"volume_closed_form", std::abs(error) <= solid.volume_tolerance, error,
                            formatted("volume differs from the solid's formula by %.3g %%, expected at most %.3g %%",
                                      100 * error, 100 * solid.volume_tolerance)});
  }
  return shape;
}

ShapeOrder order_of(const CommandLine& line, const SolidRecipe& recipe, double size) {
  nlohmann::ordered_json options{{"solid", recipe.solid}, {"parameters", recipe.parameters}};
  if (recipe.solid == "crushed-rock") options["seed"] = recipe.seed;
  options["size"] = size;
  options["size_is"] = line.size_is;
  const std::string text = options.dump();
  const std::string name = line.name.empty() ? recipe.solid : line.name;
  const std::string number = line.count > 1 ? formatted("_%03d", static_cast<int>(recipe.seed - line.seed) + 1) : "";
  return {name + number, {recipe.solid, catalog::sha256(text.data(), text.size()), tool_version(), text}, [=, &line] {
            return built_shape(recipe, size, line.size_is);
          }};
}

int generate(const CommandLine& line) {
  if (line.lists_solids) {
    list_solids();
    return kDone;
  }
  if (line.solid.empty()) throw catalog::UsageError("no solid named; --list tells them");
  if (line.catalog_path.empty()) throw catalog::UsageError("no catalogue named; add --into ore.talus");
  if (line.size.empty()) throw catalog::UsageError("no size given; add --size '12 mm'");
  if (line.count > 1 && line.solid != "crushed-rock")
    throw catalog::UsageError("--count: every " + line.solid + " is the same; only crushed-rock may be counted");
  SolidRecipe recipe = recipe_of(line);
  const double size = positive_length("--size", line.size);
  std::vector<ShapeOrder> orders;
  for (int k = 0; k < line.count; ++k, ++recipe.seed) orders.push_back(order_of(line, recipe, size));
  catalog::ShapeCatalog catalog = catalogue_to_fill(line.catalog_path);
  return report_made_shapes("generate", make_shapes(catalog, orders), line.is_json);
}

}  // namespace
}  // namespace workflows

int main(int argc, char** argv) {
  workflows::CommandLine line;
  CLI::App app(workflows::kDescription, "talus generate");
  workflows::declare_options(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return workflows::ended_status(app, error);
  }
  return workflows::run_stage("generate", [&] { return workflows::generate(line); });
}
