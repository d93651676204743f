// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/ct_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "shape_pipeline/digitization.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/shape_descriptors.h"
#include "shape_pipeline/solid_checks.h"
#include "shape_pipeline/volumes/grain_labels.h"
#include "shape_pipeline/volumes/grain_surface.h"
#include "shape_pipeline/volumes/grey_filters.h"
#include "shape_pipeline/volumes/stack_file.h"

namespace shape_pipeline {
namespace {

constexpr double kLeastGrain = 4;              // voxels a diameter: below, a speck of noise rather than a grain
constexpr double kVoxelCountTolerance = 0.05;  // of the volume, at 10 voxels a diameter and above

/// Everything known of a stack when its grains are surfaced.
struct PartedStack {
  GreyVolume volume;
  GreyClasses classes;
  GrainLabels labels;
};

/// Volume-equivalent diameter over the side of a voxel [-].
double diameter_in_voxels(const LabelledGrain& grain) {
  return std::cbrt(6 * static_cast<double>(grain.voxels) / std::numbers::pi);
}

PartedStack part_stack(GreyVolume volume, const std::string& name, const StackOptions& options) {
  PartedStack stack;
  stack.volume = std::move(volume);
  if (options.denoising == StackDenoising::median) median_filter(stack.volume);
  if (options.denoising == StackDenoising::gaussian) gaussian_filter(stack.volume, options.gaussian_sigma);
  stack.classes = options.threshold
                      ? classes_at(stack.volume, (*options.threshold - stack.volume.offset) / stack.volume.step)
                      : plateau_classes(stack.volume);
  if (stack.classes.separability == 0)
    refuse_file(
        name, "",
        options.threshold ? "no grey value lies on the one side of the threshold" : "all voxels are equally grey",
        options.threshold ? "state another --threshold, in the file's grey values" : "export the stack again");
  stack.labels = separate_grains(stack.volume, stack.classes.threshold, {options.neck_ratio, 0.75});
  return stack;
}

/// The surface that bounds a grain and those of its cavities, which look inwards.
struct GrainSurfaces {
  catalog::TriangleMesh outer, cavities;
};

GrainSurfaces parted_surfaces(const catalog::TriangleMesh& mesh) {
  const std::vector<int> component = face_components(mesh);
  const int count = component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1;
  std::vector<double> volume(static_cast<std::size_t>(count), 0);
  const auto of_face = [&](std::size_t f) { return static_cast<std::size_t>(component[f]); };
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::array<catalog::Point, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = mesh.vertices[static_cast<std::size_t>(mesh.faces[f][i])];
    volume[of_face(f)] += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
                          p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
                          p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  const std::size_t largest = static_cast<std::size_t>(std::max_element(volume.begin(), volume.end()) - volume.begin());
  std::vector<bool> is_outer(mesh.face_count()), is_cavity(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    is_outer[f] = of_face(f) == largest;
    is_cavity[f] = volume[of_face(f)] < 0;
  }
  return {submesh(mesh, is_outer), submesh(mesh, is_cavity)};
}

void append(catalog::TriangleMesh& mesh, const catalog::TriangleMesh& more) {
  const int shift = static_cast<int>(mesh.vertex_count());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const catalog::Triangle& face : more.faces)
    mesh.faces.push_back({face[0] + shift, face[1] + shift, face[2] + shift});
}

StackGrain digitized_grain(const PartedStack& stack, std::size_t grain, const StackOptions& options) {
  StackGrain result;
  const LabelledGrain& labelled = stack.labels.grains[grain];
  result.diameter = diameter_in_voxels(labelled);
  if (result.diameter < options.least_diameter) {
    char text[120];
    std::snprintf(text, sizeof text, "%.1f voxels a diameter, at least %.4g are asked for", result.diameter,
                  options.least_diameter);
    result.refusal = text;
    return result;
  }
  GrainSurfaces surfaces = parted_surfaces(grain_surface(stack.volume, stack.classes, stack.labels, grain));
  const double cavities = -signed_volume(surfaces.cavities), outer = signed_volume(surfaces.outer);
  SolidExpectation expectation;
  expectation.second_volume = static_cast<double>(labelled.voxels) * stack.volume.grid.voxel_volume() + cavities;
  expectation.second_volume_tolerance = kVoxelCountTolerance;
  std::vector<catalog::Check> checks = solid_checks(surfaces.outer, expectation);
  checks.push_back({"stack_resolution", true, result.diameter, "voxels a volume-equivalent diameter"});
  checks.push_back({"stack_threshold", true, stack.classes.threshold * stack.volume.step + stack.volume.offset,
                    "grey value of the surface"});
  checks.push_back({"stack_cavities", true, cavities / outer,
                    options.keeps_cavities ? "volume of cavities, kept, over that of the outer surface"
                                           : "volume of cavities, filled, over that of the outer surface"});
  if (options.keeps_cavities) append(surfaces.outer, surfaces.cavities);
  RemeshedMesh remeshed = remesh(surfaces.outer, options.remeshing);
  result.centre = catalog::mass_properties(remeshed.mesh).centroid;
  result.shape = in_principal_frame(remeshed.mesh);
  result.shape.checks = std::move(checks);
  result.shape.checks.insert(result.shape.checks.end(), remeshed.checks.begin(), remeshed.checks.end());
  result.shape.descriptors = shape_descriptors(result.shape.mesh);
  result.shape.descriptors["voxels_per_diameter"] = result.diameter;
  return result;
}

/// The whole grains that are no specks, the largest first, of equals the one that begins first in the stack.
std::vector<std::size_t> whole_grains(const GrainLabels& labels, StackSummary& summary) {
  std::vector<std::size_t> grains;
  for (std::size_t g = 0; g < labels.grains.size(); ++g) {
    if (diameter_in_voxels(labels.grains[g]) < kLeastGrain)
      ++summary.specks;
    else if (labels.grains[g].touches_border)
      ++summary.at_border;
    else
      grains.push_back(g);
  }
  std::stable_sort(grains.begin(), grains.end(),
                   [&](std::size_t a, std::size_t b) { return labels.grains[a].voxels > labels.grains[b].voxels; });
  return grains;
}

}  // namespace

StackSummary digitize_stack(const std::filesystem::path& path, const StackOptions& options,
                            const std::function<void(StackGrain&&)>& take) {
  return digitize_stack(read_stack(path, {options.voxel_size, options.memory_limit}), path.string(), options, take);
}

StackSummary digitize_stack(GreyVolume volume, const std::string& name, const StackOptions& options,
                            const std::function<void(StackGrain&&)>& take) {
  const PartedStack stack = part_stack(std::move(volume), name, options);
  StackSummary summary;
  summary.voxel_size = stack.volume.grid.spacing;
  summary.threshold = stack.classes.threshold * stack.volume.step + stack.volume.offset;
  const std::vector<std::size_t> grains = whole_grains(stack.labels, summary);
  if (grains.empty())
    refuse_file(name, "",
                "no whole grain above the threshold of " + std::to_string(summary.threshold) + " (" +
                    std::to_string(summary.at_border) + " cut by the border, " + std::to_string(summary.specks) +
                    " specks)",
                "look at the stack and state --threshold");
  summary.grains = grains.size();
  for (const std::size_t grain : grains) {
    StackGrain digitized = digitized_grain(stack, grain, options);
    summary.refused += digitized.refusal.empty() ? 0 : 1;
    take(std::move(digitized));
  }
  return summary;
}

}  // namespace shape_pipeline
