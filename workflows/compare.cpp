// SPDX-License-Identifier: GPL-3.0-or-later
// talus-compare: what one capture of a particle makes of it, beside another.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "shape_pipeline/digitization.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/shape_families.h"
#include "shape_pipeline/solid_alignment.h"
#include "workflows/command_options.h"
#include "workflows/stage_tool.h"
#include "workflows/surface_map.h"
#include "workflows/units.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

struct CommandLine {
  fs::path first, second, out;
  std::string unit, second_unit;
  int faces = 10000;
  bool is_json = false;
};

constexpr char kDescription[] =
    "Example: talus compare scanner.stl phone.stl --unit m --out difference\n\n"
    "Digitises two captures of one particle, aligns the second to the first and tells what differs: volume, area,\n"
    "sphericity, roughness, distances of the surfaces. --out writes the second as difference.vtp (ParaView), in the\n"
    "frame of the first's principal axes, with its distance from the first at each vertex, positive outside. The exit\n"
    "status is 4 if a check did not pass, of a capture or of the alignment.";

constexpr int kRoughnessDegree = 10;  // detail finer than R / 10 is roughness, R the volume-equivalent radius
constexpr double kLargestRatio = 5;   // of the sizes of two captures of one particle

struct Row {
  std::string name;
  double first, second;
};

/// Root mean square distance of a surface from itself without fine detail, over the volume-equivalent radius, and the
/// check that carries it, which is named for the method.
struct Roughness {
  std::string method;
  double value = std::nan("");
};

Roughness roughness(const catalog::TriangleMesh& mesh) {
  for (const catalog::Check& check : shape_pipeline::low_passed(mesh, kRoughnessDegree).checks)
    if (check.name.starts_with("low_pass_")) return {check.name, check.figure};
  return {};
}

catalog::ShapeRecord capture(const fs::path& scan, const std::string& option, const std::string& unit, int faces) {
  const std::optional<double> metres = length_unit(unit);
  if (!metres)
    throw catalog::UsageError(option + ": expected one of " + accepted_units(Dimension::length) + ", found '" + unit +
                              "'; state the unit of the coordinates");
  shape_pipeline::DigitizationOptions options;
  options.metres_per_unit = *metres;
  options.remeshing.face_limit = static_cast<std::size_t>(faces);
  return shape_pipeline::digitize(scan, options);
}

void refuse_other_units(const CommandLine& line, const catalog::ShapeRecord& first,
                        const catalog::ShapeRecord& second) {
  const double ratio =
      shape_pipeline::bounding_diagonal(second.mesh.vertices) / shape_pipeline::bounding_diagonal(first.mesh.vertices);
  if (ratio <= kLargestRatio && ratio >= 1 / kLargestRatio) return;
  char text[80];
  std::snprintf(text, sizeof text, ": is %.4g times as large as ", ratio);
  throw catalog::InputError(line.second.string() + text + line.first.string() +
                            "; captures of one particle have one size: state its unit with --second-unit");
}

std::vector<Row> rows(const catalog::ShapeRecord& first, const catalog::ShapeRecord& second) {
  std::vector<Row> table{{"volume", first.mass_properties.volume, second.mass_properties.volume}};
  for (const char* name :
       {"surface_area", "sphericity_wadell", "convexity_volume_ratio", "axis_short_obb", "axis_intermediate_obb",
        "axis_long_obb", "roundness_corner_radius", "angularity_corner_radius", "roughness_sa_iso25178",
        "roughness_sq_iso25178", "roughness_sdq_iso25178"}) {
    const auto a = first.descriptors.find(name), b = second.descriptors.find(name);
    if (a != first.descriptors.end() && b != second.descriptors.end()) table.push_back({name, a->second, b->second});
  }
  return table;
}

nlohmann::ordered_json json_of(const catalog::SurfaceDistance& distance) {
  return {{"mean", distance.mean}, {"percentile_95", distance.percentile_95}, {"largest", distance.largest}};
}

struct Comparison {
  std::vector<Row> rows;
  std::vector<catalog::Check> checks;  // of the alignment
  std::vector<std::string> failed;     // "scanner.stl: filled_area_share"
  shape_pipeline::ShapeDifference difference;
};

void print_json(const CommandLine& line, const Comparison& comparison) {
  nlohmann::ordered_json result{{"first", line.first.string()}, {"second", line.second.string()}};
  for (const Row& row : comparison.rows)
    result["figures"][row.name] = {
        {"first", row.first}, {"second", row.second}, {"relative_difference", row.second / row.first - 1}};
  for (const catalog::Check& check : comparison.checks) result["alignment"][check.name] = check.figure;
  result["distance_mean_signed"] = comparison.difference.mean_signed;
  result["distance_from_second"] = json_of(comparison.difference.from_moved);
  result["distance_from_first"] = json_of(comparison.difference.from_fixed);
  result["failed_checks"] = comparison.failed;
  std::printf("%s\n", result.dump().c_str());
}

void print_distance(const char* name, const catalog::SurfaceDistance& distance) {
  std::printf("%-28s mean %.3f %%, 95 %% below %.3f %%, largest %.3f %% of the first's diagonal\n", name,
              100 * distance.mean, 100 * distance.percentile_95, 100 * distance.largest);
}

void print_table(const CommandLine& line, const Comparison& comparison) {
  std::printf("first %s, second %s, SI units\n%-28s %12s %12s %12s\n", line.first.filename().string().c_str(),
              line.second.filename().string().c_str(), "", "first", "second", "difference");
  for (const Row& row : comparison.rows)
    std::printf("%-28s %12.5g %12.5g %+10.2f %%\n", row.name.c_str(), row.first, row.second,
                100 * (row.second / row.first - 1));
  print_distance("second to first", comparison.difference.from_moved);
  print_distance("first to second", comparison.difference.from_fixed);
  std::printf("%-28s %.4g m outside the first\n", "second on average", comparison.difference.mean_signed);
  for (const catalog::Check& check : comparison.checks)
    std::printf("%-28s %s: %s\n", check.name.c_str(), check.passed ? "passed" : "FAILED", check.detail.c_str());
}

int compare(const CommandLine& line) {
  const std::string second_unit = line.second_unit.empty() ? line.unit : line.second_unit;
  const catalog::ShapeRecord first = capture(line.first, "--unit", line.unit, line.faces);
  const catalog::ShapeRecord second = capture(line.second, "--second-unit", second_unit, line.faces);
  refuse_other_units(line, first, second);
  const shape_pipeline::SolidAlignment alignment = shape_pipeline::align_solids(second.mesh, first.mesh);
  const catalog::TriangleMesh aligned = shape_pipeline::moved(alignment.motion, second.mesh);

  Comparison comparison{
      rows(first, second), alignment.checks, {}, shape_pipeline::shape_difference(aligned, first.mesh)};
  const Roughness first_roughness = roughness(first.mesh), second_roughness = roughness(second.mesh);
  comparison.rows.push_back({"roughness_degree_10", first_roughness.value, second_roughness.value});
  if (first_roughness.method != second_roughness.method)
    comparison.failed.push_back("roughness_degree_10: by " + first_roughness.method + " and " +
                                second_roughness.method);
  const auto collect = [&](const std::string& name, const std::vector<catalog::Check>& checks) {
    for (const catalog::Check& check : checks)
      if (!check.passed) comparison.failed.push_back(name + ": " + check.name);
  };
  collect(line.first.filename().string(), first.checks);
  collect(line.second.filename().string(), second.checks);
  collect("alignment", alignment.checks);
  if (!line.out.empty()) {
    fs::create_directories(line.out);
    write_surface_map(line.out / "difference.vtp", aligned, "distance", comparison.difference.distances);
  }
  line.is_json ? print_json(line, comparison) : print_table(line, comparison);
  for (const std::string& failed : comparison.failed)
    std::fprintf(stderr, "compare: check did not pass: %s\n", failed.c_str());
  return comparison.failed.empty() ? kDone : kCheckNotPassed;
}

}  // namespace
}  // namespace workflows

int main(int argc, char** argv) {
  workflows::CommandLine line;
  CLI::App app(workflows::kDescription, "talus compare");
  app.add_option("FIRST", line.first, "capture that the other is held against")->required();
  app.add_option("SECOND", line.second, "capture to judge")->required();
  app.add_option("--unit", line.unit, "length unit of the captures")->required();
  app.add_option("--second-unit", line.second_unit, "of the second, if it has another");
  app.add_option("--faces", line.faces, "largest number of faces kept of each")
      ->check(CLI::Range(100, 10000000))
      ->capture_default_str();
  app.add_option("--out", line.out, "folder for difference.vtp; made if it is missing");
  app.add_flag("--json", line.is_json, "a JSON object on stdout");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return workflows::ended_status(app, error);
  }
  return workflows::run_stage("compare", [&] { return workflows::compare(line); });
}
