// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/quality/ray_volumes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "catalog/mass_properties.h"
#include "decomposition/geometry/box_heaps.h"
#include "decomposition/geometry/random.h"
#include "decomposition/solid/ray_grid.h"
#include "decomposition/solid/round_frame.h"
#include "decomposition/solid/surface_pieces.h"

namespace decomposition {
namespace {

// Streams of random numbers of heaps, beside those of the ray sets, which count from 0, and of the surfaces.
constexpr std::uint64_t kHeapStream = 2000;

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

/// The volumes of a mesh of that volume [m3] and of hulls.
RayVolumes traced(const catalog::TriangleMesh& mesh, double volume, const std::vector<catalog::TriangleMesh>& hulls,
                  const QualityOptions& options) {
  RayVolumes result;
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
  for (const double difference : differences) result.symmetric_difference += difference / sets;
  double variance = 0;
  for (const double difference : differences)
    variance += (difference - result.symmetric_difference) * (difference - result.symmetric_difference);
  if (sets > 1) result.method_error = std::sqrt(variance / (sets * (sets - 1)));
  result.missing_volume = (total.mesh - total.common) / (sets * volume);
  result.overlap = total.parts_union > 0 ? total.parts / total.parts_union - 1 : 0;
  return result;
}

/// The same in the round frame of the mesh.
RayVolumes traced_round(const catalog::TriangleMesh& mesh, std::vector<catalog::TriangleMesh> hulls,
                        const QualityOptions& options) {
  const RoundFrame frame(mesh);
  if (frame.is_identity()) return traced(mesh, catalog::volume_moments(mesh).volume, hulls, options);
  for (catalog::TriangleMesh& hull : hulls) hull = frame.to_round(std::move(hull));
  const catalog::TriangleMesh round_mesh = frame.to_round(mesh);
  return traced(round_mesh, catalog::volume_moments(round_mesh).volume, hulls, options);
}

double volume_of(const catalog::TriangleMesh& mesh) { return catalog::volume_moments(mesh).volume; }

}  // namespace

RayVolumes ray_volumes(const catalog::TriangleMesh& mesh, const std::vector<catalog::TriangleMesh>& bodies,
                       const std::vector<catalog::TriangleMesh>& hulls, const QualityOptions& options) {
  std::vector<Box> boxes;
  for (const catalog::TriangleMesh& body : bodies) boxes.push_back(bounding_box(body));
  for (const catalog::TriangleMesh& hull : hulls) boxes.push_back(bounding_box(hull));
  const std::vector<Heap> heaps = bodies.empty() ? std::vector<Heap>{} : heaps_of(boxes);
  const bool has_lone_parts =
      std::any_of(heaps.begin(), heaps.end(), [&](const Heap& heap) { return heap.front() >= bodies.size(); });
  if (heaps.size() < 2 || has_lone_parts) return traced_round(mesh, hulls, options);
  RayVolumes result;
  double variance = 0, parts = 0, parts_union = 0;
  for (std::size_t h = 0; h < heaps.size(); ++h) {
    catalog::TriangleMesh own_mesh;
    std::vector<catalog::TriangleMesh> own_hulls;
    double own_parts = 0;
    for (const std::size_t k : heaps[h])
      if (k < bodies.size()) {
        add_mesh(bodies[k], own_mesh);
      } else {
        own_hulls.push_back(hulls[k - bodies.size()]);
        own_parts += volume_of(own_hulls.back());
      }
    QualityOptions own = options;
    own.seed = sub_seed(options.seed, kHeapStream + h);
    const RayVolumes volumes = traced_round(own_mesh, own_hulls, own);
    const double share = volume_of(own_mesh) / volume_of(mesh);
    result.symmetric_difference += share * volumes.symmetric_difference;
    variance += share * volumes.method_error * share * volumes.method_error;
    result.missing_volume += share * volumes.missing_volume;
    parts += own_parts;
    parts_union += own_parts / (1 + volumes.overlap);
  }
  result.method_error = std::sqrt(variance);
  result.overlap = parts_union > 0 ? parts / parts_union - 1 : 0;
  return result;
}

}  // namespace decomposition
