// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/quality/surface_distance.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace decomposition {
namespace {

constexpr double kShare = 0.95;

bool is_covered(const Vec3& p, const catalog::ConvexPart& part, double tolerance) {
  return std::all_of(part.faces.begin(), part.faces.end(), [&](const catalog::ConvexFace& face) {
    return dot(to_vec3(face.plane.normal), p) - face.plane.offset <= tolerance;
  });
}

/// Triangles of the parts' faces, those of outer faces alone if asked for, each with the number of its part.
struct PartSurface {
  TriangleSoup triangles;
  std::vector<std::size_t> owner;
};

PartSurface surface_of(const std::vector<catalog::ConvexPart>& parts, bool outer_only) {
  PartSurface surface;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const catalog::ConvexFace& face : parts[p].faces) {
      if (outer_only && face.kind != catalog::FaceKind::outer) continue;
      const auto at = [&](std::size_t k) {
        return to_vec3(parts[p].vertices[static_cast<std::size_t>(face.vertices[k])]);
      };
      for (std::size_t corner = 2; corner < face.vertices.size(); ++corner) {
        surface.triangles.push_back({at(0), at(corner - 1), at(corner)});
        surface.owner.push_back(p);
      }
    }
  return surface;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Least value that at least kShare of all are at most, where each set has the same weight; neither empty, both
/// ascending.
double percentile_of(const std::vector<double>& first, const std::vector<double>& second) {
  std::size_t i = 0, j = 0;
  const auto share = [](std::size_t passed, const std::vector<double>& of) {
    return static_cast<double>(passed) / static_cast<double>(of.size());
  };
  double value = 0;
  while (share(i, first) + share(j, second) < 2 * kShare)
    value = j == second.size() || (i < first.size() && first[i] <= second[j]) ? first[i++] : second[j++];
  return value;
}

}  // namespace

TriangleSoup soup(const catalog::TriangleMesh& mesh) {
  TriangleSoup triangles;
  triangles.reserve(mesh.face_count());
  for (const catalog::Triangle& face : mesh.faces)
    triangles.push_back({to_vec3(mesh.vertices[static_cast<std::size_t>(face[0])]),
                         to_vec3(mesh.vertices[static_cast<std::size_t>(face[1])]),
                         to_vec3(mesh.vertices[static_cast<std::size_t>(face[2])])});
  return triangles;
}

SpreadPoints spread_points(const TriangleSoup& triangles, int count, Random& random) {
  std::vector<double> passed;
  double total = 0;
  for (const auto& [a, b, c] : triangles) passed.push_back(total += norm(cross(b - a, c - a)) / 2);
  SpreadPoints spread;
  std::size_t t = 0;
  for (int k = 0; k < count && !triangles.empty(); ++k) {
    const double target = total * (k + random.uniform()) / count;
    while (t + 1 < triangles.size() && passed[t] < target) ++t;
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const auto& [a, b, c] = triangles[t];
    spread.points.push_back(a + u * (b - a) + v * (c - a));
    spread.source.push_back(t);
  }
  return spread;
}

std::vector<double> distances_to_union(const std::vector<Vec3>& mesh_points,
                                       const std::vector<catalog::ConvexPart>& parts) {
  const TriangleTree tree(surface_of(parts, true).triangles);
  std::vector<double> distances;
  distances.reserve(mesh_points.size());
  for (const Vec3& p : mesh_points) distances.push_back(tree.distance(p));
  return distances;
}

std::vector<double> distances_to_mesh(const std::vector<catalog::ConvexPart>& parts, const TriangleTree& mesh,
                                      int count, double tolerance, Random& random) {
  const PartSurface surface = surface_of(parts, false);
  const SpreadPoints spread = spread_points(surface.triangles, count, random);
  std::vector<double> distances;
  for (std::size_t k = 0; k < spread.points.size(); ++k) {
    const std::size_t owner = surface.owner[spread.source[k]];
    bool is_inner = false;
    for (std::size_t other = 0; other < parts.size() && !is_inner; ++other)
      is_inner = other != owner && is_covered(spread.points[k], parts[other], tolerance);
    if (!is_inner) distances.push_back(mesh.distance(spread.points[k]));
  }
  return distances;
}

catalog::SurfaceDistance summary(std::vector<double> distances, double length) {
  if (distances.empty()) return {};
  std::sort(distances.begin(), distances.end());
  return {mean(distances) / length, percentile_of(distances, distances) / length, distances.back() / length};
}

catalog::SurfaceDistance summary(std::vector<double> first, std::vector<double> second, double length) {
  if (first.empty() || second.empty()) return summary(first.empty() ? std::move(second) : std::move(first), length);
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  return {(mean(first) + mean(second)) / 2 / length, percentile_of(first, second) / length,
          std::max(first.back(), second.back()) / length};
}

}  // namespace decomposition
