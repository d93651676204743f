// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/shape_descriptors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/mass_properties.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/convex_hull.h"
#include "shape_pipeline/surfaces/minimum_box.h"
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

}  // namespace

std::map<std::string, double> shape_descriptors(const catalog::TriangleMesh& mesh) {
  constexpr double pi = std::numbers::pi;
  const double volume = signed_volume(mesh), area = surface_area(mesh);
  const catalog::TriangleMesh hull = convex_hull(mesh.vertices);
  const double hull_volume = signed_volume(hull);
  Point axis = minimum_volume_box(hull).extent;
  std::sort(axis.begin(), axis.end());
  const auto [s, i, l] = axis;
  const auto [f3, f2, f1] = surface_orientation_eigenvalues(mesh, area);
  return {{"volume", volume},
          {"surface_area", area},
          {"volume_hull", hull_volume},
          {"equivalent_diameter_volume", std::cbrt(6 * volume / pi)},
          {"sphericity_wadell", std::cbrt(pi) * std::pow(6 * volume, 2.0 / 3) / area},
          {"convexity_volume_ratio", volume / hull_volume},
          {"axis_short_obb", s},
          {"axis_intermediate_obb", i},
          {"axis_long_obb", l},
          {"zingg_s_over_i", s / i},
          {"zingg_i_over_l", i / l},
          {"sphericity_krumbein_intercept", std::cbrt(s * i / (l * l))},
          {"flatness_kong_fonseca", (i - s) / i},
          {"elongation_kong_fonseca", (l - i) / l},
          {"compactness_bagi_orosz", f3 / f1},
          {"flakiness_bagi_orosz", (f1 - f2) / f1},
          {"rodness_bagi_orosz", (f2 - f3) / f1},
          {"feret_max", largest_vertex_distance(hull.vertices)},
          {"sieve_size_second_axis", i},
          {"face_count", static_cast<double>(mesh.faces.size())},
          {"mean_edge_length", mean_edge_length(mesh)}};
}

}  // namespace shape_pipeline
