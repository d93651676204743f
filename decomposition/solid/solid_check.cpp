// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/solid_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "decomposition/geometry/vector3.h"

namespace decomposition {
namespace {

// Volume over diagonal cubed: below this a mesh is a sheet. A plate of 1 x 1 x 1e-5 has 4e-6.
constexpr double kFlat = 1e-7;

/// Number of edges that are not run through as often one way as the other.
std::size_t count_open_edges(const catalog::TriangleMesh& mesh) {
  struct Edge {
    int low, high, direction;
    bool operator<(const Edge& other) const { return low != other.low ? low < other.low : high < other.high; }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.faces.size());
  for (const catalog::Triangle& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = face[k], b = face[(k + 1) % 3];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  for (std::size_t first = 0, last; first < edges.size(); first = last) {
    int balance = 0;
    for (last = first; last < edges.size() && !(edges[first] < edges[last]); ++last) balance += edges[last].direction;
    if (balance != 0) ++open;
  }
  return open;
}

}  // namespace

void check_closed_solid(const catalog::TriangleMesh& mesh) {
  const auto refuse = [](const std::string& what) { throw catalog::InputError("mesh: " + what); };
  if (mesh.faces.empty()) refuse("it has no faces; a closed triangle mesh is needed, digitise the particle again");
  const int n = static_cast<int>(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const int v : mesh.faces[f])
      if (v < 0 || v >= n)
        refuse("face " + std::to_string(f) + " names vertex " + std::to_string(v) + ", expected 0 to " +
               std::to_string(n - 1));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    for (const double coordinate : mesh.vertices[v])
      if (!std::isfinite(coordinate)) refuse("vertex " + std::to_string(v) + " is not finite; repair the mesh first");
  if (const std::size_t open = count_open_edges(mesh); open > 0)
    refuse(std::to_string(open) + " open edges, expected a closed surface; repair the mesh with talus digitize");
  const Vec3 corner = to_vec3(mesh.vertices[static_cast<std::size_t>(mesh.faces[0][0])]);
  Box box{corner, corner};
  for (const catalog::Triangle& face : mesh.faces)
    for (const int v : face) box.extend(to_vec3(mesh.vertices[static_cast<std::size_t>(v)]));
  const double diagonal = box.diagonal();
  const double share = catalog::volume_moments(mesh).volume / (diagonal * diagonal * diagonal);
  if (!(std::abs(share) > kFlat)) refuse("it is flat, its volume is zero; a solid is needed");
  if (share < 0) refuse("its normals point inward, its volume is negative; turn its faces round");
}

}  // namespace decomposition
