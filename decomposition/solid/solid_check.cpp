// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/solid_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "decomposition/geometry/vector3.h"
#include "decomposition/solid/ray_grid.h"
#include "decomposition/solid/surface_pieces.h"

namespace decomposition {
namespace {

// Volume over diagonal cubed: below this a mesh is a sheet. A plate of 1 x 1 x 1e-5 has 4e-6.
constexpr double kFlat = 1e-7;
// Coordinates and sizes whose fifth powers (second moments) and the squares of areas keep well within doubles [m].
constexpr double kLargestCoordinate = 1e12, kSmallestDiagonal = 1e-12;
// Of the volume: what surfaces that cut themselves may add to or take from it, as much as parts may miss it by.
constexpr double kMostMiscounted = 1e-3;
constexpr int kRaysAcross = 256;  // over the longer side of the box

[[noreturn]] void refuse(const std::string& what) { throw catalog::InputError("mesh: " + what); }

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string per_cent(double share) { return number(100 * share) + " %"; }

/// Volume beyond a winding number of 1, and below one of 0 [m3].
struct Miscount {
  double repeated = 0, inverted = 0;
};

Miscount miscounted_volume(const catalog::TriangleMesh& mesh, const Box& box) {
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const catalog::Point& p : mesh.vertices) vertices.push_back(to_vec3(p));
  RayGrid rays;
  rays.cell = std::max(box.high.x - box.low.x, box.high.y - box.low.y) / kRaysAcross;
  rays.x0 = box.low.x;
  rays.y0 = box.low.y;
  rays.nx = static_cast<int>((box.high.x - box.low.x) / rays.cell) + 1;
  rays.ny = static_cast<int>((box.high.y - box.low.y) / rays.cell) + 1;
  const RayIntervals inside = intersect(rays, vertices, mesh.faces);
  const double area = rays.cell * rays.cell;
  return {inside.repeated * area, inside.inverted * area};
}

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

void check_closed_surface(const catalog::TriangleMesh& mesh) {
  if (mesh.faces.empty()) refuse("it has no faces; a closed triangle mesh is needed, digitise the particle again");
  const int n = static_cast<int>(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const int v : mesh.faces[f])
      if (v < 0 || v >= n)
        refuse("face " + std::to_string(f) + " names vertex " + std::to_string(v) + ", expected 0 to " +
               std::to_string(n - 1) + "; write the mesh again");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    for (const double coordinate : mesh.vertices[v]) {
      if (!std::isfinite(coordinate)) refuse("vertex " + std::to_string(v) + " is not finite; repair the mesh first");
      if (std::abs(coordinate) > kLargestCoordinate)
        refuse("vertex " + std::to_string(v) + " lies " + number(coordinate) +
               " m from the origin, expected at most 1e12; check the unit of the scan");
    }
  if (const std::size_t open = count_open_edges(mesh); open > 0)
    refuse(std::to_string(open) + " open edges, expected a closed surface; repair the mesh with talus digitize");
}

double check_solid(const catalog::TriangleMesh& mesh) {
  const Vec3 corner = to_vec3(mesh.vertices[static_cast<std::size_t>(mesh.faces[0][0])]);
  Box box{corner, corner};
  for (const catalog::Triangle& face : mesh.faces)
    for (const int v : face) box.extend(to_vec3(mesh.vertices[static_cast<std::size_t>(v)]));
  const double diagonal = box.diagonal();
  if (!(diagonal >= kSmallestDiagonal))
    refuse("it is " + number(diagonal) + " m across, expected at least 1e-12; check the unit of the scan");
  const double volume = catalog::volume_moments(mesh).volume;
  // Bodies apart are looked at one by one: the distance between them says nothing of any.
  const std::vector<catalog::TriangleMesh> bodies = bodies_apart(mesh);
  double cubes = bodies.empty() ? diagonal * diagonal * diagonal : 0;
  for (const catalog::TriangleMesh& body : bodies) cubes += std::pow(bounding_box(body).diagonal(), 3);
  const double share = volume / cubes;
  if (!(std::abs(share) > kFlat))
    refuse("it is flat, its volume is " + number(share) +
           " of its diagonal cubed, expected more than 1e-7; scan the particle from all sides or leave it out");
  if (share < 0)
    refuse(
        "it is inside out, its normals point inward and its volume is negative; turn its faces round, or repair it "
        "with "
        "talus digitize");
  Miscount miscount;
  if (bodies.empty()) miscount = miscounted_volume(mesh, box);
  for (const catalog::TriangleMesh& body : bodies) {
    const Miscount own = miscounted_volume(body, bounding_box(body));
    miscount.repeated += own.repeated;
    miscount.inverted += own.inverted;
  }
  const double enclosed = volume - miscount.repeated + miscount.inverted;  // once
  const double sum = miscount.repeated + miscount.inverted;
  if (!(sum <= kMostMiscounted * enclosed))
    refuse(per_cent(miscount.repeated / enclosed) + " of its volume is enclosed more than once and " +
           per_cent(miscount.inverted / enclosed) +
           " inside out, expected at most 0.1 % together: faces cut one another or stand there twice; repair the mesh "
           "with talus digitize");
  return sum / enclosed;
}

}  // namespace decomposition
