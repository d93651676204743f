// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "catalog/mass_properties.h"
#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/mesh_repair.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/shape_descriptors.h"
#include "shape_pipeline/surface_distance.h"
#include "shape_pipeline/surface_reconstruction.h"
#include "shape_pipeline/virtual_scan.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/digitize/digitize_cases.h"

namespace workflows {
namespace {

using catalog::TriangleMesh;
namespace sp = shape_pipeline;

constexpr int kSamples = 50000;  // of a surface: its mean distance to another is then known to half a percent

double mean_distance(const TriangleMesh& from, const TriangleMesh& to) {
  sp::ScannerFlaws sampling;
  sampling.points = kSamples;
  sampling.noise_sigma = sampling.gap_angle = 0;
  sampling.stray_points = 0;
  double sum = 0;
  for (const double distance : sp::distances_to_surface(sp::virtual_scan(from, sampling).points, to)) sum += distance;
  return sum / kSamples;
}

/// Names as in the catalogue; what a scanner's noise and resolution are feared to change.
const std::vector<std::string> kSpreadDescriptors{"volume",
                                                  "surface_area",
                                                  "sphericity_wadell",
                                                  "convexity_volume_ratio",
                                                  "zingg_s_over_i",
                                                  "zingg_i_over_l",
                                                  "roundness_corner_radius",
                                                  "angularity_corner_radius",
                                                  "corner_area_share",
                                                  "sphericity_krumbein_intercept"};

struct Scanner {
  std::string name;
  double noise;  // standard deviation over the rock's size [-]
};
const std::vector<Scanner> kScanners{{"scanner of noise 0.05 %", 5e-4}, {"scanner of noise 0.2 %", 2e-3}};
constexpr int kResolutions[] = {3000, 6000, 12000, 24000};  // points

double spread(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value;
  return (*high - *low) * static_cast<double>(values.size()) / sum;
}

std::vector<double> joined(std::vector<double> first, const std::vector<double>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

CaseResult measure_cloud(const std::filesystem::path& scans, const CloudPair& pair) {
  CaseResult result;
  const auto add = [&](const std::string& name, double value, const std::string& unit, std::optional<Goal> goal) {
    result.figures.push_back({name, value, unit, goal, ""});
  };
  const TriangleMesh truth = sp::repair_mesh(sp::read_mesh(scans / pair.mesh, 1), {0, sp::Wrapping::never}).mesh;
  const CpuClock clock;
  const sp::Reconstruction made =
      sp::reconstruct_surface(sp::read_cloud(scans / pair.cloud, sp::CloudReading{}).cloud, {});
  const double seconds = clock.seconds();
  if (!made.refusal.empty()) {
    result.figures.push_back({"closed [-]", std::nullopt, "", std::nullopt, made.refusal});
    return result;
  }
  const sp::MeshTopology topology = sp::mesh_topology(made.mesh);
  const double diagonal = sp::bounding_diagonal(truth.vertices);
  add("closed: open, forked and turned edges", topology.is_closed() ? 0 : 1, "-", at_most(0));
  add("Euler number off 2", std::abs(static_cast<double>(topology.euler_number - 2)), "-", at_most(0));
  add("volume error", 100 * std::abs(sp::signed_volume(made.mesh) / sp::signed_volume(truth) - 1), "%", at_most(0.5));
  add("area error", 100 * std::abs(sp::surface_area(made.mesh) / sp::surface_area(truth) - 1), "%", at_most(1));
  add("mean distance to the authors' mesh over its diagonal", 100 * mean_distance(made.mesh, truth) / diagonal, "%",
      at_most(0.15));
  add("mean distance of the authors' mesh over its diagonal", 100 * mean_distance(truth, made.mesh) / diagonal, "%",
      std::nullopt);
  add("CPU time", seconds, "s", at_most(3));
  return result;
}

CaseResult measure_scanner_spread() {
  CaseResult result;
  for (const auto& [rock_name, angularity] : {std::pair{"pebble", 8.0}, std::pair{"crushed", 40.0}}) {
    sp::RockRecipe recipe;
    recipe.angularity = angularity;
    const TriangleMesh rock = sp::virtual_rock(recipe);
    std::vector<std::map<std::string, std::vector<double>>> seen(kScanners.size());
    for (std::size_t s = 0; s < kScanners.size(); ++s)
      for (const int points : kResolutions) {
        sp::ScannerFlaws flaws;
        flaws.seed = s + 1;
        flaws.points = points;
        flaws.noise_sigma = kScanners[s].noise * recipe.size;
        const sp::Reconstruction made = sp::reconstruct_surface(sp::virtual_scan(rock, flaws), {});
        if (!made.refusal.empty()) {
          result.figures.push_back(
              {std::string(rock_name) + ", " + kScanners[s].name + ", " + std::to_string(points) + " points",
               std::nullopt, "", std::nullopt, made.refusal});
          continue;
        }
        for (const auto& [name, value] : sp::shape_descriptors(made.mesh)) seen[s][name].push_back(value);
      }
    for (const std::string& name : kSpreadDescriptors) {
      const std::string what = std::string(rock_name) + ", " + name + ": spread over ";
      for (std::size_t s = 0; s < kScanners.size(); ++s)
        result.figures.push_back(
            {what + "resolutions, " + kScanners[s].name, 100 * spread(seen[s][name]), "%", {}, ""});
      result.figures.push_back(
          {what + "scanners and resolutions", 100 * spread(joined(seen[0][name], seen[1][name])), "%", {}, ""});
    }
  }
  return result;
}

}  // namespace workflows
