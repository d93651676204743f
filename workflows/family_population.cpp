// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/family_population.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <vector>

#include "catalog/input_error.h"
#include "workflows/atomic_file.h"
#include "workflows/command_options.h"
#include "workflows/made_shapes.h"
#include "workflows/population/comparison_report.h"
#include "workflows/population/stratified_rows.h"
#include "workflows/stage_tool.h"
#include "workflows/text_format.h"
#include "workflows/thread_count.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

std::string options_text(const PopulationLine& line, const FormTable& reference, std::size_t number, std::size_t row) {
  nlohmann::ordered_json target;
  for (std::size_t c = 0; c < kFormFigures; ++c) target[kFormNames[c]] = reference.rows[row][c];
  const nlohmann::ordered_json options{{"action", "population"}, {"count", line.count},   {"seed", line.options.seed},
                                       {"select", line.select},  {"number", number},      {"row", row + 1},
                                       {"target", target},       {"axes", reference.axes}};
  return options.dump();
}

std::string shape_name(const PopulationLine& line, std::size_t number) {
  return formatted("%s_%04zu", (line.name.empty() ? line.reference.stem().string() : line.name).c_str(), number);
}

/// Shapes are made all together, once one is found missing: each carries the checks of all.
std::vector<ShapeOrder> orders_of(const PopulationLine& line, const FormTable& reference,
                                  const std::vector<std::size_t>& rows, std::optional<MatchedShapes>& made) {
  std::vector<ShapeOrder> orders;
  for (std::size_t k = 0; k < rows.size(); ++k)
    orders.push_back(
        {shape_name(line, k + 1),
         {reference.source, reference.sha256, tool_version(), options_text(line, reference, k + 1, rows[k])},
         [&, k] {
           if (!made) made = matched_shapes(reference, rows, line.options);
           return made->shapes[k];
         }});
  return orders;
}

/// Of the population as a whole, which every shape carries.
std::vector<catalog::Check> whole_checks(const catalog::ShapeCatalog& catalog, const std::string& shape) {
  std::vector<catalog::Check> checks = catalog.shape(*catalog.find(shape)).checks;
  std::erase_if(checks, [](const catalog::Check& check) { return !check.name.starts_with("population_"); });
  return checks;
}

std::string report_text(const std::string& comparison, const std::vector<catalog::Check>& checks,
                        const std::vector<MadeShape>& shapes) {
  std::string text = comparison;
  for (const catalog::Check& check : checks)
    if (check.name.ends_with("_targets") || check.name.ends_with("_assumption"))
      text += formatted("%s %.4g: %s\n", check.name.c_str(), check.figure, check.detail.c_str());
  return text +
         formatted("%zu shapes, %s to %s\n", shapes.size(), shapes.front().name.c_str(), shapes.back().name.c_str());
}

std::string report_json(const std::string& comparison, const std::vector<catalog::Check>& checks,
                        const std::vector<MadeShape>& shapes) {
  nlohmann::ordered_json result{{"comparison", nlohmann::ordered_json::parse(comparison)}};
  for (const catalog::Check& check : checks)
    result["population_checks"].push_back(
        {{"name", check.name}, {"passed", check.passed}, {"figure", check.figure}, {"detail", check.detail}});
  for (const MadeShape& shape : shapes)
    result["shapes"].push_back({{"name", shape.name},
                                {"status", shape.status},
                                {"descriptors", shape.summary.descriptors},
                                {"failed_checks", shape.summary.failed_checks}});
  return result.dump() + "\n";
}

int report(const PopulationLine& line, const FormTable& reference, const catalog::ShapeCatalog& catalog,
           const std::vector<MadeShape>& shapes) {
  std::vector<FormRow> rows;
  std::set<std::string> failed;
  for (const MadeShape& shape : shapes) {
    rows.push_back(form_row(shape.name, shape.summary.descriptors));
    for (const std::string& check : shape.summary.failed_checks)
      failed.insert(check.starts_with("population_") ? check : shape.name + ": " + check);
  }
  const std::string made = line.catalog_path.filename().string();
  const PopulationComparison comparison = compare_populations(reference.rows, rows, Samples::drawn_from_reference);
  const std::vector<catalog::Check> checks = whole_checks(catalog, shapes.front().name);
  const std::string text = line.is_json
                               ? report_json(comparison_json(comparison, reference.source, made), checks, shapes)
                               : report_text(comparison_text(comparison, reference.source, made), checks, shapes);
  std::fputs(text.c_str(), stdout);
  if (!line.plot.empty()) write_whole(line.plot, distributions_svg({reference.source, reference.rows}, {made, rows}));
  for (const std::string& check : failed) std::fprintf(stderr, "family: check did not pass: %s\n", check.c_str());
  return failed.empty() ? kDone : kCheckNotPassed;
}

}  // namespace

void declare_population(CLI::App& app, PopulationLine& line) {
  CLI::App* command = app.add_subcommand("population", "new shapes whose descriptors match those of many grains");
  command->add_option("REFERENCE", line.reference, "CSV file of descriptors, or a catalogue")->required();
  add_whole_number(*command, "--count", line.count, {10, 10000}, "how many shapes");
  command->get_option("--count")->required();
  command->add_option("--into", line.catalog_path, "catalogue file; made if it is missing")->required();
  add_seed(*command, "--seed", line.options.seed, "of the rows drawn and of the shapes");
  command->add_option("--select", line.select, "only these shapes of a catalogue as reference");
  command->add_option("--name", line.name, "of the shapes, before their number; else the reference's");
  command->add_option("--plot", line.plot, "SVG file of the cumulative distributions");
  command->add_option("--threads", line.options.threads, "0: as many as the machine has")
      ->check(CLI::Range(0, kMostThreads));
  command->add_flag("--json", line.is_json, "one JSON object on stdout");
}

namespace {

/// Shapes of a larger population that an earlier run made of the same reference.
void remove_rest(catalog::ShapeCatalog& catalog, const PopulationLine& line, const FormTable& reference) {
  int removed = 0;
  for (std::size_t number = static_cast<std::size_t>(line.count) + 1;; ++number) {
    const std::string name = shape_name(line, number);
    const auto id = catalog.find(name);
    if (!id || catalog.shape(*id).provenance.source_file != reference.source) break;
    catalog.remove_shape(name);
    ++removed;
  }
  if (removed > 0) std::fprintf(stderr, "family: %d shapes of an earlier, larger population removed\n", removed);
}

}  // namespace

int run_population(const PopulationLine& line) {
  if (!line.plot.empty()) require_own_place(line.plot, "--plot", "<svg");
  const FormTable reference = read_form_table(line.reference, line.select);
  if (fs::exists(line.catalog_path) && fs::equivalent(line.catalog_path, line.reference))
    throw catalog::InputError(line.catalog_path.string() +
                              ": is the reference itself, which would change with every run; name another by --into");
  catalog::ShapeCatalog catalog = catalogue_to_fill(line.catalog_path);
  const std::vector<std::size_t> rows =
      representative_rows(reference.rows, static_cast<std::size_t>(line.count), line.options.seed);
  std::optional<MatchedShapes> made;
  const std::vector<ShapeOrder> orders = orders_of(line, reference, rows, made);
  const std::vector<MadeShape> shapes = make_shapes(catalog, orders);
  remove_rest(catalog, line, reference);
  return report(line, reference, catalog, shapes);
}

}  // namespace workflows
