// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/solid_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/convex_hull.h"

namespace shape_pipeline {
namespace {

constexpr double kHullSlack = 1e-6;  // rounding of two volumes that are equal for a convex solid

std::string text(const char* format, double a, double b) {
  char line[160];
  std::snprintf(line, sizeof line, format, a, b);
  return line;
}

}  // namespace

std::vector<catalog::Check> solid_checks(const catalog::TriangleMesh& mesh, const SolidExpectation& expectation) {
  const MeshTopology topology = mesh_topology(mesh);
  const auto flaws =
      static_cast<double>(topology.boundary_edges + topology.non_manifold_edges + topology.misoriented_edges);
  const auto components = static_cast<double>(topology.components);
  const auto euler_number = static_cast<double>(topology.euler_number);
  const double expected_euler_number = 2 * expectation.surfaces - 2 * expectation.genus;
  const double volume = signed_volume(mesh);
  const double hull_volume = signed_volume(convex_hull(mesh.vertices));
  const double hull_ratio = hull_volume > 0 ? volume / hull_volume : 0;

  std::vector<catalog::Check> checks{
      {"closed", topology.is_closed() && !mesh.faces.empty(), flaws,
       text("%.0f open, forked or misoriented edges, expected %.0f", flaws, 0)},
      {"one_component", topology.components == static_cast<std::size_t>(expectation.surfaces), components,
       text("%.0f separate surfaces, expected %.0f", components, expectation.surfaces)},
      {"euler_number", euler_number == expected_euler_number, euler_number,
       text("Euler number %.0f, expected %.0f", euler_number, expected_euler_number)},
      {"positive_volume", volume > 0, volume, text("volume %.6g m3, expected more than %.0f", volume, 0)},
      {"volume_hull_ratio", hull_ratio >= expectation.least_hull_ratio && hull_ratio <= 1 + kHullSlack, hull_ratio,
       text("volume / convex hull volume is %.4f, expected %.2f to 1", hull_ratio, expectation.least_hull_ratio)}};
  if (expectation.second_volume > 0) {
    const double difference = volume / expectation.second_volume - 1;
    checks.push_back({"volume_second_method", std::abs(difference) <= expectation.second_volume_tolerance, difference,
                      text("volume differs by %.2f %% from the winding-number volume, expected at most %.0f %%",
                           100 * difference, 100 * expectation.second_volume_tolerance)});
  }
  return checks;
}

bool all_passed(const std::vector<catalog::Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const catalog::Check& check) { return check.passed; });
}

std::string failures(const std::vector<catalog::Check>& checks) {
  std::string list;
  for (const catalog::Check& check : checks)
    if (!check.passed) list += (list.empty() ? "" : "; ") + check.detail;
  return list;
}

}  // namespace shape_pipeline
