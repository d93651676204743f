// SPDX-License-Identifier: GPL-3.0-or-later
// talus-family: shapes made from a stored shape, and populations from the descriptors of many.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "shape_pipeline/described_shape.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/shape_families.h"
#include "workflows/command_options.h"
#include "workflows/family_population.h"
#include "workflows/made_shapes.h"
#include "workflows/stage_tool.h"
#include "workflows/text_format.h"

namespace workflows {
namespace {

struct CommandLine {
  std::filesystem::path catalog_path;
  std::string source, name;
  double s_over_i = 0, i_over_l = 0;
  std::vector<double> angularities, convexities;
  double tolerance = 0.005;
  int degree = 0;
  bool is_json = false;
  PopulationLine population;
};

constexpr char kDescription[] =
    "Example: talus family stretch ore.talus rock_01 --s-over-i 0.6 --i-over-l 0.8\n\n"
    "Makes shapes from a stored shape, of the same volume, and stores them beside it with the hash of what they were\n"
    "made from. What cannot be reached is refused, with the nearest that was. population makes many that match the\n"
    "descriptors of measured grains: talus family population sand.csv --count 300 --into sand.talus";

CLI::App* action(CLI::App& app, CommandLine& line, const char* name, const char* purpose) {
  CLI::App* command = app.add_subcommand(name, purpose);
  command->add_option("CATALOGUE", line.catalog_path, "catalogue file")->required();
  command->add_option("SHAPE", line.source, "name of the shape to begin with")->required();
  command->add_option("--name", line.name, "name of the new shape; else made from what is asked");
  command->add_flag("--json", line.is_json, "one JSON object a shape on stdout");
  return command;
}

void declare_actions(CLI::App& app, CommandLine& line) {
  app.require_subcommand(1);
  CLI::App* stretch = action(app, line, "stretch", "to given ratios of the box of least volume");
  stretch->add_option("--s-over-i", line.s_over_i, "short over intermediate side, up to 1")->required();
  stretch->add_option("--i-over-l", line.i_over_l, "intermediate over long side, up to 1")->required();
  CLI::App* angularity = action(app, line, "angularity", "rounded or sharpened to angularity_corner_radius");
  angularity->add_option("--target", line.angularities, "one or several, such as 0.05,0.1")->required()->delimiter(',');
  angularity->add_option("--tolerance", line.tolerance, "largest difference from the target")->capture_default_str();
  CLI::App* convexity = action(app, line, "convexity", "with flatter or deeper hollows, to convexity_volume_ratio");
  convexity->add_option("--target", line.convexities, "one or several, such as 0.8,0.9")->required()->delimiter(',');
  convexity->add_option("--tolerance", line.tolerance, "largest difference from the target")->capture_default_str();
  CLI::App* low_pass = action(app, line, "low-pass", "without fine detail: spherical harmonics, or Taubin's filter");
  low_pass->add_option("--degree", line.degree, "finest detail kept, 1 to 30")->required();
  declare_population(app, line.population);
}

catalog::ShapeRecord member_shape(const shape_pipeline::FamilyMember& member, int genus) {
  catalog::ShapeRecord shape = shape_pipeline::described_shape(member.mesh, genus);
  shape.checks.insert(shape.checks.begin(), member.checks.begin(), member.checks.end());
  return shape;
}

std::string mesh_hash(const catalog::TriangleMesh& mesh) {
  std::string bytes(reinterpret_cast<const char*>(mesh.vertices.data()), mesh.vertices.size() * sizeof(catalog::Point));
  bytes.append(reinterpret_cast<const char*>(mesh.faces.data()), mesh.faces.size() * sizeof(catalog::Triangle));
  return catalog::sha256(bytes.data(), bytes.size());
}

int run(const CLI::App& app, const CommandLine& line) {
  const std::string verb = app.get_subcommands().front()->get_name();
  if (verb == "population") return run_population(line.population);
  if (!std::filesystem::exists(line.catalog_path))
    throw catalog::InputError(line.catalog_path.string() + ": there is no such catalogue; check the path");
  catalog::ShapeCatalog catalog = catalogue_to_fill(line.catalog_path);
  const auto id = catalog.find(line.source);
  if (!id)
    throw catalog::InputError(line.catalog_path.string() + ": has no shape '" + line.source +
                              "'; talus catalog list tells the names");
  const catalog::TriangleMesh mesh = catalog.shape(*id).mesh;
  const auto genus = static_cast<int>((2 - shape_pipeline::mesh_topology(mesh).euler_number) / 2);
  const std::string hash = mesh_hash(mesh);

  std::vector<ShapeOrder> orders;
  const auto add = [&](const std::string& suffix, nlohmann::ordered_json options, auto make) {
    options["action"] = verb;
    orders.push_back({line.name.empty() ? line.source + suffix : line.name,
                      {line.source, hash, tool_version(), options.dump()},
                      [make, genus] { return member_shape(make(), genus); }});
  };
  if (verb == "stretch")
    add(formatted("_s%g_i%g", line.s_over_i, line.i_over_l), {{"s_over_i", line.s_over_i}, {"i_over_l", line.i_over_l}},
        [&] { return shape_pipeline::stretched(mesh, line.s_over_i, line.i_over_l); });
  if (verb == "low-pass")
    add(formatted("_d%d", line.degree), {{"degree", line.degree}},
        [&] { return shape_pipeline::low_passed(mesh, line.degree); });
  if (line.angularities.size() + line.convexities.size() > 1 && !line.name.empty())
    throw catalog::UsageError("--name fits one target only; several are given");
  for (const double target : line.angularities)
    add(formatted("_a%g", target), {{"angularity", target}, {"tolerance", line.tolerance}},
        [&, target] { return shape_pipeline::with_angularity(mesh, target, line.tolerance); });
  for (const double target : line.convexities)
    add(formatted("_c%g", target), {{"convexity", target}, {"tolerance", line.tolerance}},
        [&, target] { return shape_pipeline::with_convexity(mesh, target, line.tolerance); });
  return report_made_shapes("family", make_shapes(catalog, orders), line.is_json);
}

}  // namespace
}  // namespace workflows

int main(int argc, char** argv) {
  workflows::CommandLine line;
  CLI::App app(workflows::kDescription, "talus family");
  workflows::declare_actions(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return workflows::ended_status(app, error);
  }
  return workflows::run_stage("family", [&] { return workflows::run(app, line); });
}
