// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/families/smoothing.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kLambda = 0.5;        // share of a shrinking step (Taubin 1995)
constexpr double kPassBandLoss = 0.1;  // of a wave at twice the pass band's wave number, what stays

void umbrella_step(catalog::TriangleMesh& mesh, double share) {
  std::vector<Point> sum(mesh.vertices.size());
  std::vector<int> count(mesh.vertices.size());
  for (const catalog::Triangle& face : mesh.faces)
    for (int c = 0; c < 3; ++c) {  // on a closed surface each neighbour comes once this way
      sum[face[c]] = add(sum[face[c]], mesh.vertices[face[(c + 1) % 3]]);
      ++count[face[c]];
    }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (count[v] > 0) mesh.vertices[v] = add(scaled(mesh.vertices[v], 1 - share), scaled(sum[v], share / count[v]));
}

}  // namespace

catalog::TriangleMesh umbrella_steps(catalog::TriangleMesh mesh, double share, int steps) {
  for (int step = 0; step < steps; ++step) umbrella_step(mesh, share);
  return mesh;
}

catalog::TriangleMesh taubin_low_pass(const catalog::TriangleMesh& mesh, double wave_number) {
  // On equilateral triangles of edge h the umbrella takes k^2 h^2 / 4 of a wave of wave number k, for k h << 1.
  const double edge = mean_edge_length(mesh);
  const auto taken = [&](double k) { return std::min(1.0, k * k * edge * edge / 4); };
  const double pass = std::clamp(taken(wave_number), 1e-4, 0.9);
  const double mu = 1 / (pass - 1 / kLambda);  // both steps together leave the pass band's edge as it is
  const double stop = std::min(1.5, 4 * pass);
  const double left = std::abs((1 - kLambda * stop) * (1 - mu * stop));
  const int steps = std::clamp(static_cast<int>(std::log(kPassBandLoss) / std::log(left)) + 1, 1, 2000);
  catalog::TriangleMesh result = mesh;
  for (int step = 0; step < steps; ++step) {
    umbrella_step(result, kLambda);
    umbrella_step(result, mu);
  }
  return result;
}

}  // namespace shape_pipeline
