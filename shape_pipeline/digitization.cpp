// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/digitization.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/mesh_repair.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/scan_file.h"
#include "shape_pipeline/shape_descriptors.h"
#include "shape_pipeline/solid_checks.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kTruthTolerance = 0.02;  // relative error of volume and area against a known truth

/// A closed mesh with the checks made on the way, or a refusal.
struct Solid {
  catalog::TriangleMesh mesh;
  std::vector<catalog::Check> checks;
  std::string refusal, remedy;  // remedy: where the refusal has one of its own
};

Solid solid_from_cloud(const std::filesystem::path& scan, const DigitizationOptions& options) {
  CloudReading reading;
  reading.metres_per_unit = options.metres_per_unit;
  reading.drops_nan_points = options.drops_nan_points;
  const CloudFile file = read_cloud(scan, reading);
  Reconstruction reconstruction = reconstruct_surface(file.cloud, options.reconstruction);
  reconstruction.checks.insert(reconstruction.checks.end(), file.notes.begin(), file.notes.end());
  return {std::move(reconstruction.mesh), std::move(reconstruction.checks), std::move(reconstruction.refusal), ""};
}

Solid solid_from_mesh(const std::filesystem::path& scan, const DigitizationOptions& options) {
  if (options.reconstruction.method == ReconstructionMethod::poisson)
    refuse_file(scan, "", "the Poisson method is for point clouds, this is a mesh", "use --method auto or alpha-wrap");
  RepairOptions repair;
  repair.genus = options.reconstruction.genus;
  repair.bodies = options.bodies;
  if (options.reconstruction.method == ReconstructionMethod::alpha_wrap) repair.wrapping = Wrapping::always;
  RepairedMesh repaired = repair_mesh(read_mesh(scan, options.metres_per_unit), repair);
  return {std::move(repaired.mesh), std::move(repaired.checks), std::move(repaired.refusal),
          std::move(repaired.remedy)};
}

void compare_with_truth(catalog::ShapeRecord& shape, const ScanTruth& truth) {
  const auto compare = [&](const char* quantity, double found, double known) {
    const double error = found / known - 1;
    char line[120];
    std::snprintf(line, sizeof line, "%s differs from the truth by %.3f %%, expected at most 2 %%", quantity,
                  100 * error);
    const std::string name = std::string(quantity) + "_error_truth";
    shape.checks.push_back({name, std::abs(error) <= kTruthTolerance, error, line});
    shape.descriptors[name] = error;
  };
  compare("volume", shape.mass_properties.volume, truth.volume);
  compare("surface_area", surface_area(shape.mesh), truth.surface_area);
}

/// The solid with its faces limited, checked, in its principal frame, described and at its size.
catalog::ShapeRecord described(Solid solid, const std::filesystem::path& scan, const DigitizationOptions& options,
                               const std::optional<ScanTruth>& truth) {
  if (!solid.refusal.empty())
    refuse_file(scan, "", solid.refusal,
                solid.remedy.empty() ? "scan the particle again from all sides, or state its handles with --genus"
                                     : solid.remedy);
  RemeshedMesh remeshed = remesh(solid.mesh, options.remeshing);

  catalog::ShapeRecord shape = in_principal_frame(remeshed.mesh);
  shape.checks = std::move(solid.checks);
  shape.checks.insert(shape.checks.end(), remeshed.checks.begin(), remeshed.checks.end());
  shape.descriptors = shape_descriptors(shape.mesh);
  if (truth) compare_with_truth(shape, *truth);
  if (!options.sieve_size) return shape;

  const double factor = *options.sieve_size / shape.descriptors.at("sieve_size_second_axis");
  for (Point& vertex : shape.mesh.vertices) vertex = scaled(vertex, factor);
  shape.mass_properties.volume *= std::pow(factor, 3);
  for (double& inertia : shape.mass_properties.principal_inertia) inertia *= std::pow(factor, 5);
  for (const auto& [name, value] : shape_descriptors(shape.mesh)) shape.descriptors[name] = value;
  shape.source_frame->scale = factor;
  shape.checks.push_back({"rescaled", true, factor, "size in the catalogue / size scanned"});
  return shape;
}

}  // namespace

catalog::ShapeRecord in_principal_frame(const catalog::TriangleMesh& mesh) {
  const catalog::MassProperties found = catalog::mass_properties(mesh);
  catalog::ShapeRecord shape;
  shape.mesh = mesh;
  for (Point& vertex : shape.mesh.vertices) {
    const Point arm = subtract(vertex, found.centroid);
    for (int i = 0; i < 3; ++i) vertex[i] = dot(found.principal_axes[i], arm);
  }
  shape.source_frame = {found.principal_axes, found.centroid, 1};
  shape.mass_properties.volume = found.volume;
  shape.mass_properties.principal_inertia = found.principal_inertia;
  return shape;
}

catalog::ShapeRecord digitize(const std::filesystem::path& scan, const DigitizationOptions& options,
                              const std::optional<ScanTruth>& truth) {
  return described(
      scan_kind(scan) == ScanKind::point_cloud ? solid_from_cloud(scan, options) : solid_from_mesh(scan, options), scan,
      options, truth);
}

catalog::ShapeRecord digitize_cloud(const PointCloud& cloud, const std::filesystem::path& scan,
                                    const DigitizationOptions& options, const std::vector<catalog::Check>& made) {
  Reconstruction found = reconstruct_surface(cloud, options.reconstruction);
  found.checks.insert(found.checks.begin(), made.begin(), made.end());
  return described({std::move(found.mesh), std::move(found.checks), std::move(found.refusal), ""}, scan, options,
                   std::nullopt);
}

}  // namespace shape_pipeline
