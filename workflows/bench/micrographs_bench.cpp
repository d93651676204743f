// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <filesystem>
#include <string>

#include "catalog/input_error.h"
#include "shape_pipeline/matched_population.h"
#include "shape_pipeline/micrograph.h"
#include "shape_pipeline/outline_truth.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/cpu_clock.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

constexpr double kPixel = 1036e-6 / 1536;  // [m]: the field of view that comes with the hand outlines / pixels across
constexpr int kPopulation = 200;           // grains of the matched population

struct Powder {
  const char* name;
  const char* image;
  const char* drawn;  // its name where the hand outlines were drawn
};
// Neither is wholly held out: docs/digitising.md says which constants were fitted to what.
constexpr std::array<Powder, 2> kPowders{
    {{"powder-1", "ampis_powder_Sc1Tile_001-001.png", "Sc1Tile_001-001-000_0-000.png"},
     {"powder-2", "ampis_powder_Sc2Tile_001-001.png", "Sc2Tile_001-001-000_0-000.png"}}};

fs::path data_file(const fs::path& folder, const char* name) {
  if (folder.empty())
    throw catalog::UsageError("the bench micrographs needs --scans DIR, a folder with " + std::string(name));
  if (!fs::exists(folder / name))
    throw catalog::InputError((folder / name).string() + ": no such file; --scans expects the AMPIS powder images");
  return folder / name;
}

shape_pipeline::Micrograph outlined(const fs::path& folder, const Powder& powder) {
  shape_pipeline::MicrographOptions options;
  options.pixel_size = kPixel;
  return digitize_micrograph(data_file(folder, powder.image), options);
}

CaseResult measure_outlines(const fs::path& folder, const Powder& powder) {
  const CpuClock clock;
  const shape_pipeline::Micrograph micrograph = outlined(folder, powder);
  const double seconds = clock.seconds();
  const shape_pipeline::OutlineScore score =
      score_outlines(micrograph, shape_pipeline::read_hand_outlines(data_file(folder, kHandOutlines), powder.drawn));
  const double error = 100 * score.median_error();
  return {{{"F1 at IoU 0.5", score.f1, "-", at_least(0.80), ""},
           {"precision", score.precision, "-", {}, ""},
           {"recall", score.recall, "-", {}, ""},
           {"grains outlined", static_cast<double>(score.found), "-", {}, ""},
           {"grains by hand", static_cast<double>(score.real), "-", {}, ""},
           {"median diameter of equal area, error", error, "%", {}, ""},
           {"the same, without sign", error < 0 ? -error : error, "%", at_most(3), ""},
           {"CPU time with descriptors", seconds, "s", {}, ""}},
          {}};
}

CaseResult measure_population(const fs::path& folder) {
  std::vector<shape_pipeline::Outline> outlines;
  for (const Powder& powder : kPowders)
    for (const shape_pipeline::MicrographGrain& grain : outlined(folder, powder).grains) {
      outlines.push_back(grain.outline);
      for (shape_pipeline::PlanePoint& p : outlines.back()) p = {p[0] * kPixel, p[1] * kPixel};
    }
  const CpuClock clock;
  shape_pipeline::PopulationOptions options;
  options.count = kPopulation;
  const shape_pipeline::MatchedPopulation population = matched_population(outlines, kPixel, options);
  CaseResult result;
  for (const shape_pipeline::FormComparison& row : population.comparison) {
    const std::string unit = row.name == "equivalent_diameter" ? "m" : "-";
    result.figures.push_back({row.name + ", outlines' mean", row.measured_mean, unit, {}, ""});
    result.figures.push_back({row.name + ", silhouettes' mean", row.made_mean, unit, {}, ""});
    result.figures.push_back({row.name + ", outlines' spread", row.measured_spread, unit, {}, ""});
    result.figures.push_back({row.name + ", silhouettes' spread", row.made_spread, unit, {}, ""});
  }
  result.figures.push_back({"power of I/L over the seen aspect ratio", population.ratio_power, "-", {}, ""});
  result.figures.push_back({"roughness over that seen", population.roughness_factor, "-", {}, ""});
  result.figures.push_back({"CPU time", clock.seconds(), "s", {}, ""});
  return result;
}

}  // namespace

BenchPlan plan_micrographs_bench(const BenchOptions& options) {
  BenchPlan plan;
  for (const Powder& powder : kPowders)
    plan.cases.push_back({powder.name, [folder = options.scans, powder] { return measure_outlines(folder, powder); }});
  plan.cases.push_back({"population", [folder = options.scans] { return measure_population(folder); }});
  return plan;
}

}  // namespace workflows
