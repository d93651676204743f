// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/shape_descriptors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "catalog/mass_properties.h"
#include "shape_pipeline/families/spherical_harmonics.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/shape_families.h"
#include "shape_pipeline/surfaces/convex_hull.h"
#include "shape_pipeline/surfaces/corner_measure.h"
#include "shape_pipeline/surfaces/enclosing_sphere.h"
#include "shape_pipeline/surfaces/hull_width.h"
#include "shape_pipeline/surfaces/inscribed_sphere.h"
#include "shape_pipeline/surfaces/minimum_box.h"
#include "shape_pipeline/surfaces/surface_roughness.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

double largest_vertex_distance(const std::vector<Point>& points) {
  double squared = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const Point d = subtract(points[i], points[j]);
      squared = std::max(squared, dot(d, d));
    }
  return std::sqrt(squared);
}

/// Eigenvalues, ascending, of sum A_k n n^T / A over the faces.
Point surface_orientation_eigenvalues(const catalog::TriangleMesh& mesh, double area) {
  catalog::Matrix3 tensor{};
  for (const catalog::Triangle& face : mesh.faces) {
    const Point& origin = mesh.vertices[face[0]];
    const Point twice_area = cross(subtract(mesh.vertices[face[1]], origin), subtract(mesh.vertices[face[2]], origin));
    const double length = norm(twice_area);
    if (!(length > 0)) continue;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) tensor[i][j] += twice_area[i] * twice_area[j] / (2 * length * area);
  }
  Point values;
  catalog::Matrix3 axes;
  catalog::symmetric_eigen(tensor, values, axes);
  return values;
}

using Descriptors = std::map<std::string, double>;

/// Names and formulas of the axes alone.
Descriptors form_descriptors(const Point& sorted_axes) {
  const auto [s, i, l] = sorted_axes;
  const double sum = s + i + l, long_plate = s * l + i * i;
  return {{"zingg_s_over_i", s / i},
          {"zingg_i_over_l", i / l},
          {"sphericity_krumbein_intercept", std::cbrt(s * i / (l * l))},
          {"sphericity_sneed_folk", std::cbrt(s * s / (l * i))},
          {"shape_factor_corey", s / std::sqrt(l * i)},
          {"flatness_kong_fonseca", (i - s) / i},
          {"elongation_kong_fonseca", (l - i) / l},
          {"flatness_potticary", 2 * (i - s) / sum},
          {"elongation_potticary", (l - i) / sum},
          {"flatness_angelidakis", i * i / long_plate - s / (s + l)},
          {"elongation_angelidakis", s * l / long_plate - s / (s + l)}};
}

/// Full axes, ascending, of the ellipsoid with the same volume and inertia per volume as a solid.
Point inertia_ellipsoid_axes(const catalog::MassProperties& solid) {
  const Point& moment = solid.principal_inertia;
  const double trace = moment[0] + moment[1] + moment[2];
  Point axes;
  // Integral of x^2 = V a^2 / 5 for a semi-axis a, and half the trace less the moment about that axis.
  for (int k = 0; k < 3; ++k) axes[k] = 2 * std::sqrt(std::max(0.0, 5 * (trace / 2 - moment[k]) / solid.volume));
  std::sort(axes.begin(), axes.end());
  return axes;
}

Descriptors sphere_descriptors(const catalog::TriangleMesh& mesh, const catalog::TriangleMesh& hull) {
  const double inscribed = inscribed_sphere(mesh).radius, enclosing = enclosing_radius(hull.vertices);
  Descriptors found{{"radius_inscribed", inscribed},
                    {"radius_enclosing", enclosing},
                    {"sphericity_inscribed_enclosing", inscribed / enclosing}};
  const auto corners = corner_measure(mesh, inscribed);
  if (!corners) return found;
  found["roundness_corner_radius"] = corners->roundness;
  found["angularity_corner_radius"] = corners->angularity;
  found["corner_area_share"] = corners->area_share;
  found["corner_scale"] = corners->scale;
  found["corner_scale_over_edge"] = corners->scale / mean_edge_length(mesh);
  return found;
}

constexpr int kHarmonicDegree = 15;
constexpr double kPatchRadius = 0.2;  // of roughness over the radius of the largest sphere inside

Descriptors roughness_descriptors(const catalog::TriangleMesh& mesh, double inscribed) {
  const auto found = surface_roughness(mesh, kPatchRadius * inscribed);
  if (!found) return {};
  return {{"roughness_patch_radius", found->patch_radius},
          {"roughness_sa_iso25178", found->sa},
          {"roughness_sq_iso25178", found->sq},
          {"roughness_ssk_iso25178", found->ssk},
          {"roughness_sku_iso25178", found->sku},
          {"roughness_sdq_iso25178", found->sdq}};
}

/// D_n / D_0; none for solids that are not star-shaped about their centroid.
Descriptors harmonic_descriptors(catalog::TriangleMesh mesh, const Point& centroid) {
  for (Point& vertex : mesh.vertices) vertex = subtract(vertex, centroid);
  if (!is_star_shaped(mesh)) return {};
  const std::vector<double> amplitudes = harmonic_amplitudes(mesh, kHarmonicDegree);
  Descriptors found;
  for (std::size_t n = 2; n < amplitudes.size(); ++n) {
    char name[64];
    std::snprintf(name, sizeof name, "harmonic_d%02zu_over_d00_garboczi", n);
    found[name] = amplitudes[n] / amplitudes[0];
  }
  return found;
}

}  // namespace

std::map<std::string, double> shape_descriptors(const catalog::TriangleMesh& mesh) {
  constexpr double pi = std::numbers::pi;
  const double volume = signed_volume(mesh), area = surface_area(mesh);
  const catalog::MassProperties solid = catalog::mass_properties(mesh);
  const catalog::TriangleMesh hull = convex_hull(mesh.vertices);
  const double hull_volume = signed_volume(hull);
  Point axis = minimum_volume_box(hull).extent;
  std::sort(axis.begin(), axis.end());
  const auto [s, i, l] = axis;
  const auto [f3, f2, f1] = surface_orientation_eigenvalues(mesh, area);
  const auto [ellipsoid_s, ellipsoid_i, ellipsoid_l] = inertia_ellipsoid_axes(solid);
  Descriptors found{{"volume", volume},
                    {"surface_area", area},
                    {"volume_hull", hull_volume},
                    {"equivalent_diameter_volume", std::cbrt(6 * volume / pi)},
                    {"sphericity_wadell", std::cbrt(pi) * std::pow(6 * volume, 2.0 / 3) / area},
                    {"convexity_volume_ratio", volume / hull_volume},
                    {"axis_short_obb", s},
                    {"axis_intermediate_obb", i},
                    {"axis_long_obb", l},
                    {"axis_short_inertia", ellipsoid_s},
                    {"axis_intermediate_inertia", ellipsoid_i},
                    {"axis_long_inertia", ellipsoid_l},
                    {"compactness_bagi_orosz", f3 / f1},
                    {"flakiness_bagi_orosz", (f1 - f2) / f1},
                    {"rodness_bagi_orosz", (f2 - f3) / f1},
                    {"feret_max", largest_vertex_distance(hull.vertices)},
                    {"feret_min", least_width(hull)},
                    {"sieve_size_second_axis", i},
                    {"face_count", static_cast<double>(mesh.faces.size())},
                    {"mean_edge_length", mean_edge_length(mesh)}};
  found.merge(form_descriptors(axis));
  found.merge(sphere_descriptors(mesh, hull));
  found.merge(roughness_descriptors(mesh, found.at("radius_inscribed")));
  found.merge(harmonic_descriptors(mesh, solid.centroid));
  return found;
}

}  // namespace shape_pipeline
