// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/input_error.h"
#include "shape_pipeline/digitization.h"
#include "shape_pipeline/floor_plane.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/registration.h"
#include "shape_pipeline/solid_alignment.h"
#include "shape_pipeline/surface_reconstruction.h"
#include "shape_pipeline/virtual_parts.h"
#include "shape_pipeline/virtual_scan.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/digitize/digitize_cases.h"

namespace workflows {
namespace {

namespace sp = shape_pipeline;

constexpr int kRocks = 8;
constexpr double kRockSize = 0.03;  // intermediate axis, about [m]
constexpr double kPerRadian = 180 / std::numbers::pi;

catalog::TriangleMesh bench_rock(int number) {
  sp::RockRecipe recipe;
  recipe.seed = static_cast<std::uint64_t>(number);
  recipe.size = kRockSize;
  recipe.flatness = 0.75;
  recipe.notch_depth = number % 2 == 0 ? 0.3 : 0;
  return sp::virtual_rock(recipe);
}

void add(CaseResult& result, const std::string& name, double value, const std::string& unit,
         std::optional<Goal> goal = std::nullopt) {
  result.figures.push_back({name, value, unit, goal, ""});
}

void fail(CaseResult& result, const std::string& name, const std::string& reason) {
  result.figures.push_back({name, std::nullopt, "", std::nullopt, reason});
}

}  // namespace

CaseResult measure_registration(const RegistrationCase& wanted) {
  CaseResult result;
  double rotation = 0, shift = 0, volume = 0, seconds = 0;
  for (int r = 1; r <= kRocks; ++r) {
    const catalog::TriangleMesh rock = bench_rock(r);
    const sp::VirtualParts known =
        sp::virtual_parts(rock, wanted.parts, static_cast<std::uint64_t>(r), wanted.noise * kRockSize);
    const std::string name = "rock " + std::to_string(r);
    try {
      const CpuClock clock;
      const sp::RegisteredParts found = sp::register_parts(known.parts);
      seconds = std::max(seconds, clock.seconds());
      const sp::PoseError error = sp::worst_pose_error(found, known);
      rotation = std::max(rotation, kPerRadian * error.rotation);
      shift = std::max(shift, 100 * error.shift);
      if (wanted.parts < 3) continue;  // two parts may miss the same cap
      const sp::Reconstruction made = sp::reconstruct_surface(found.merged, {});
      if (made.refusal.empty())
        volume = std::max(volume, 100 * std::abs(sp::signed_volume(made.mesh) / sp::signed_volume(rock) - 1));
      else
        fail(result, name, made.refusal);
    } catch (const catalog::InputError& error) {
      fail(result, name, error.what());
    }
  }
  add(result, "rotation, worst part", rotation, "degrees", at_most(0.5));
  add(result, "shift over the diagonal, worst part", shift, "%", at_most(0.2));
  if (wanted.parts > 2) add(result, "volume error of the merged cloud's solid, worst rock", volume, "%");
  add(result, "CPU time, slowest rock", seconds, "s");
  return result;
}

CaseResult measure_strangers() {
  CaseResult result;
  double taken = 0;
  for (int r = 1; r <= kRocks; ++r) {
    const auto part = [](int rock) {
      return sp::virtual_parts(bench_rock(rock), 1, static_cast<std::uint64_t>(rock), 1e-3 * kRockSize).parts.front();
    };
    try {
      sp::register_parts({part(r), part(r + 1)});
      ++taken;
    } catch (const catalog::InputError&) {  // as it should be
    }
  }
  add(result, "pairs of two rocks that were joined, of 8", taken, "-", at_most(0));
  return result;
}

CaseResult measure_plate() {
  CaseResult result;
  constexpr int kOnPlate = 4;
  const sp::VirtualPlate plate = sp::virtual_plate(kOnPlate, 6000, 3e-5);
  const sp::ClearedCloud cleared = sp::without_floor(plate.cloud, "plate");
  const sp::PlateGrains found = sp::separated_grains(cleared.cloud);
  add(result, "grains found too many or too few", std::abs(static_cast<double>(found.grains.size()) - kOnPlate), "-",
      at_most(0));
  double squares = 0;
  for (int i = 0; i < 3; ++i) squares += std::pow(cleared.normal[i] - plate.normal[i], 2);
  add(result, "tilt of the plane found", kPerRadian * 2 * std::asin(std::sqrt(squares) / 2), "degrees");
  std::vector<double> volumes;
  for (const sp::PointCloud& grain : found.grains) {
    const sp::Reconstruction made = sp::reconstruct_surface(grain, {});
    if (made.refusal.empty())
      volumes.push_back(sp::signed_volume(made.mesh));
    else
      fail(result, "grain " + std::to_string(volumes.size() + 1), made.refusal);
  }
  // Grains come by their points, rocks in their row: volumes in order tell which is which.
  std::vector<double> known = plate.volumes;
  std::sort(known.begin(), known.end());
  std::sort(volumes.begin(), volumes.end());
  double worst = 0;
  for (std::size_t i = 0; i < std::min(known.size(), volumes.size()); ++i)
    worst = std::max(worst, 100 * std::abs(volumes[i] / known[i] - 1));
  add(result, "volume error, worst grain, foot hidden", worst, "%");
  return result;
}

CaseResult measure_captures(const std::filesystem::path& scans) {
  CaseResult result;
  const auto capture = [&](const std::string& name, const std::string& file) {
    const CpuClock clock;
    catalog::ShapeRecord shape = sp::digitize(scans / file, {});
    add(result, name + ", CPU time", clock.seconds(), "s");
    const sp::MeshTopology topology = sp::mesh_topology(shape.mesh);
    add(result, name + ", closed: open, forked and turned edges", topology.is_closed() ? 0 : 1, "-", at_most(0));
    add(result, name + ", Euler number off 2", std::abs(static_cast<double>(topology.euler_number - 2)), "-",
        at_most(0));
    for (const catalog::Check& check : shape.checks)
      if (check.name.starts_with("deviation_")) add(result, name + ", " + check.name, 100 * check.figure, "%");
    return shape;
  };
  const catalog::ShapeRecord scanner = capture("scanner", kCaptureFiles[0]), phone = capture("phone", kCaptureFiles[1]);
  const sp::SolidAlignment alignment = sp::align_solids(phone.mesh, scanner.mesh);
  for (const catalog::Check& check : alignment.checks) add(result, check.name, check.figure, "-");
  for (const char* name : {"surface_area", "sphericity_wadell", "convexity_volume_ratio", "angularity_corner_radius"})
    add(result, std::string("phone less scanner, ") + name,
        100 * (phone.descriptors.at(name) / scanner.descriptors.at(name) - 1), "%");
  add(result, "phone less scanner, volume", 100 * (phone.mass_properties.volume / scanner.mass_properties.volume - 1),
      "%");
  return result;
}

}  // namespace workflows
