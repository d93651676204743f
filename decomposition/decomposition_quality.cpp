// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/decomposition_quality.h"

#include <algorithm>
#include <utility>

#include "catalog/mass_properties.h"
#include "decomposition/geometry/random.h"
#include "decomposition/quality/triangle_tree.h"
#include "decomposition/solid/ray_grid.h"

namespace decomposition {
namespace {

using TriangleSoup = std::vector<std::array<Vec3, 3>>;

// Share of the diagonal: a sample point this deep in another part, or on its surface, is covered by it.
constexpr double kCovered = 1e-9;

std::vector<Vec3> turned(const std::vector<catalog::Point>& points, const Frame& frame) {
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const catalog::Point& p : points) result.push_back(frame(to_vec3(p)));
  return result;
}

/// Lengths along all rays of one bundle.
struct RayLengths {
  double mesh = 0, parts = 0, parts_union = 0, common = 0;
};

double length_of(const std::vector<ZInterval>& intervals) {
  double length = 0;
  for (const ZInterval& interval : intervals) length += interval.high - interval.low;
  return length;
}

std::vector<ZInterval> merged(std::vector<ZInterval> intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const ZInterval& a, const ZInterval& b) { return a.low < b.low; });
  std::vector<ZInterval> result;
  for (const ZInterval& interval : intervals)
    if (!result.empty() && interval.low <= result.back().high)
      result.back().high = std::fmax(result.back().high, interval.high);
    else
      result.push_back(interval);
  return result;
}

RayLengths trace(const catalog::TriangleMesh& mesh, const std::vector<catalog::TriangleMesh>& hulls, int rays_across,
                 Random& random) {
  const Frame frame = random_frame(random);
  const std::vector<Vec3> vertices = turned(mesh.vertices, frame);
  std::vector<std::vector<Vec3>> hull_vertices;
  std::vector<Vec3> all = vertices;
  for (const catalog::TriangleMesh& hull : hulls) {
    hull_vertices.push_back(turned(hull.vertices, frame));
    all.insert(all.end(), hull_vertices.back().begin(), hull_vertices.back().end());
  }
  const Box box = bounding_box(all);
  RayGrid grid;
  grid.cell = std::fmax(box.high.x - box.low.x, box.high.y - box.low.y) / rays_across;
  grid.x0 = box.low.x - grid.cell * random.uniform();
  grid.y0 = box.low.y - grid.cell * random.uniform();
  grid.nx = static_cast<int>((box.high.x - grid.x0) / grid.cell) + 1;
  grid.ny = static_cast<int>((box.high.y - grid.y0) / grid.cell) + 1;
  for (int ray = 0; ray < grid.count(); ++ray) {
    grid.shift_x.push_back(random.uniform());
    grid.shift_y.push_back(random.uniform());
  }
  const RayIntervals solid = intersect(grid, vertices, mesh.faces);
  std::vector<RayIntervals> parts;
  for (std::size_t h = 0; h < hulls.size(); ++h) parts.push_back(intersect(grid, hull_vertices[h], hulls[h].faces));
  RayLengths sum;
  for (std::size_t ray = 0; ray < static_cast<std::size_t>(grid.count()); ++ray) {
    const auto of_ray = [&](const RayIntervals& of) {
      return std::vector<ZInterval>(of.intervals.begin() + static_cast<std::ptrdiff_t>(of.first[ray]),
                                    of.intervals.begin() + static_cast<std::ptrdiff_t>(of.first[ray + 1]));
    };
    const std::vector<ZInterval> rock = of_ray(solid);
    std::vector<ZInterval> stretches;
    for (const RayIntervals& part : parts) {
      const std::vector<ZInterval> own = of_ray(part);
      sum.parts += length_of(own);
      stretches.insert(stretches.end(), own.begin(), own.end());
    }
    const std::vector<ZInterval> covered = merged(std::move(stretches));
    sum.mesh += length_of(rock);
    sum.parts_union += length_of(covered);
    for (const ZInterval& a : rock)
      for (const ZInterval& b : covered)
        sum.common += std::fmax(0.0, std::fmin(a.high, b.high) - std::fmax(a.low, b.low));
  }
  const double area = grid.cell * grid.cell;
  return {sum.mesh * area, sum.parts * area, sum.parts_union * area, sum.common * area};
}

TriangleSoup soup(const catalog::TriangleMesh& mesh) {
  TriangleSoup triangles;
  for (const catalog::Triangle& face : mesh.faces)
    triangles.push_back({to_vec3(mesh.vertices[static_cast<std::size_t>(face[0])]),
                         to_vec3(mesh.vertices[static_cast<std::size_t>(face[1])]),
                         to_vec3(mesh.vertices[static_cast<std::size_t>(face[2])])});
  return triangles;
}

/// Points spread over the triangles in proportion to their area, each with the number of its triangle.
std::vector<std::pair<Vec3, std::size_t>> spread_points(const TriangleSoup& triangles, int count, Random& random) {
  std::vector<double> passed;
  double total = 0;
  for (const auto& [a, b, c] : triangles) passed.push_back(total += norm(cross(b - a, c - a)) / 2);
  std::vector<std::pair<Vec3, std::size_t>> points;
  std::size_t t = 0;
  for (int k = 0; k < count; ++k) {
    const double target = total * (k + random.uniform()) / count;
    while (t + 1 < triangles.size() && passed[t] < target) ++t;
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const auto& [a, b, c] = triangles[t];
    points.push_back({a + u * (b - a) + v * (c - a), t});
  }
  return points;
}

bool is_covered(const Vec3& p, const catalog::ConvexPart& part, double tolerance) {
  return std::all_of(part.faces.begin(), part.faces.end(), [&](const catalog::ConvexFace& face) {
    return dot(to_vec3(face.plane.normal), p) - face.plane.offset <= tolerance;
  });
}

void measure_surfaces(const catalog::TriangleMesh& mesh, const std::vector<catalog::ConvexPart>& parts,
                      const QualityOptions& options, double diagonal, catalog::DecompositionError& error) {
  Random random(sub_seed(options.seed, 99));
  const TriangleSoup mesh_triangles = soup(mesh);
  TriangleSoup part_triangles, outer_triangles;
  std::vector<std::size_t> owner;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const catalog::ConvexFace& face : parts[p].faces)
      for (std::size_t corner = 2; corner < face.vertices.size(); ++corner) {
        const auto at = [&](std::size_t k) {
          return to_vec3(parts[p].vertices[static_cast<std::size_t>(face.vertices[k])]);
        };
        part_triangles.push_back({at(0), at(corner - 1), at(corner)});
        owner.push_back(p);
        if (face.kind == catalog::FaceKind::outer) outer_triangles.push_back(part_triangles.back());
      }
  const TriangleTree mesh_tree(mesh_triangles), outer_tree(outer_triangles);
  double sum[2] = {0, 0};
  int count[2] = {0, 0};
  const auto add = [&](int direction, double distance) {
    sum[direction] += distance / diagonal;
    ++count[direction];
    error.surface_max = std::fmax(error.surface_max, distance / diagonal);
  };
  for (const auto& [p, triangle] : spread_points(mesh_triangles, options.surface_samples, random))
    add(0, outer_tree.distance(p));
  for (const auto& [p, triangle] : spread_points(part_triangles, options.surface_samples, random)) {
    bool is_inner = false;
    for (std::size_t other = 0; other < parts.size() && !is_inner; ++other)
      is_inner = other != owner[triangle] && is_covered(p, parts[other], kCovered * diagonal);
    if (!is_inner) add(1, mesh_tree.distance(p));
  }
  error.surface_mean = (sum[0] / std::max(1, count[0]) + sum[1] / std::max(1, count[1])) / 2;
}

}  // namespace

catalog::DecompositionError measure_error(const catalog::TriangleMesh& mesh,
                                          const std::vector<catalog::ConvexPart>& parts,
                                          const QualityOptions& options) {
  catalog::DecompositionError error;
  std::vector<catalog::TriangleMesh> hulls;
  double part_volume = 0;
  for (const catalog::ConvexPart& part : parts) {
    hulls.push_back(catalog::triangulated(part));
    part_volume += catalog::volume_moments(hulls.back()).volume;
  }
  const double volume = catalog::volume_moments(mesh).volume;
  error.volume_error = part_volume / volume - 1;
  std::vector<double> differences;
  RayLengths total;
  for (int set = 0; set < options.ray_sets; ++set) {
    Random random(sub_seed(options.seed, static_cast<std::uint64_t>(set)));
    const RayLengths lengths = trace(mesh, hulls, options.rays_across, random);
    differences.push_back((lengths.mesh + lengths.parts_union - 2 * lengths.common) / volume);
    total.mesh += lengths.mesh;
    total.parts += lengths.parts;
    total.parts_union += lengths.parts_union;
    total.common += lengths.common;
  }
  const double sets = std::max(1, options.ray_sets);
  for (const double difference : differences) error.symmetric_difference += difference / sets;
  double variance = 0;
  for (const double difference : differences)
    variance += (difference - error.symmetric_difference) * (difference - error.symmetric_difference);
  if (sets > 1) error.method_error = std::sqrt(variance / (sets * (sets - 1)));
  error.missing_volume = (total.mesh - total.common) / (sets * volume);
  error.overlap = total.parts_union > 0 ? total.parts / total.parts_union - 1 : 0;
  std::vector<Vec3> corners;
  for (const catalog::Point& p : mesh.vertices) corners.push_back(to_vec3(p));
  measure_surfaces(mesh, parts, options, bounding_box(corners).diagonal(), error);
  return error;
}

}  // namespace decomposition
