// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/decomposition_quality.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "catalog/mass_properties.h"
#include "decomposition/geometry/faceted_hull.h"
#include "decomposition/geometry/random.h"
#include "decomposition/quality/surface_distance.h"
#include "decomposition/solid/ray_grid.h"
#include "decomposition/solid/round_frame.h"

namespace decomposition {
namespace {

// Share of the diagonal: a sample point this deep in another part, or on its surface, is covered by it.
constexpr double kCovered = 1e-9;
// Streams of random numbers beside those of the ray sets, which count from 0.
constexpr std::uint64_t kMeshStream = 1000, kPartStream = 1001;

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

/// Volumes by rays: symmetric difference with its standard error, missing volume, overlap.
void measure_volumes(const catalog::TriangleMesh& mesh, const std::vector<catalog::TriangleMesh>& hulls,
                     const QualityOptions& options, double volume, catalog::DecompositionError& error) {
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
}

double norm_of(const catalog::Matrix3& matrix) {  // Frobenius
  double sum = 0;
  for (const auto& row : matrix)
    for (const double entry : row) sum += entry * entry;
  return std::sqrt(sum);
}

catalog::Matrix3 difference(catalog::Matrix3 a, const catalog::Matrix3& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a[i][j] -= b[i][j];
  return a;
}

/// What convexity is told to: far above the rounding of its sums.
constexpr double kConvexityUnit = 1e-12;

double hull_volume(const std::vector<Vec3>& points) {
  double six_volumes = 0;
  for (const auto& [a, b, c] : hull_triangles(points))
    six_volumes += dot(points[static_cast<std::size_t>(a)] - points.front(),
                       cross(points[static_cast<std::size_t>(b)] - points.front(),
                             points[static_cast<std::size_t>(c)] - points.front()));
  return six_volumes / 6;
}

}  // namespace

/// What is the same for all parts that are measured against a mesh.
struct ErrorMeasurement::Reference {
  const catalog::TriangleMesh& mesh;
  QualityOptions options;
  catalog::VolumeMoments moments;
  // Volumes are compared in the round frame, which changes no share of them: seen from most sides a needle or a plate
  // is too narrow for the rays.
  RoundFrame frame;
  std::optional<catalog::TriangleMesh> round_mesh;  // where that is another
  double diagonal, convexity;
  std::vector<Vec3> surface_points;
  TriangleTree surface;
};

ErrorMeasurement::ErrorMeasurement(const catalog::TriangleMesh& mesh, const QualityOptions& options) {
  std::vector<Vec3> corners;
  corners.reserve(mesh.vertex_count());
  for (const catalog::Point& p : mesh.vertices) corners.push_back(to_vec3(p));
  const catalog::VolumeMoments moments = catalog::volume_moments(mesh);
  TriangleSoup triangles = soup(mesh);
  Random random(sub_seed(options.seed, kMeshStream));
  std::vector<Vec3> points = spread_points(triangles, options.surface_samples, random).points;
  const RoundFrame frame(mesh);
  std::optional<catalog::TriangleMesh> round_mesh;
  if (!frame.is_identity()) round_mesh = frame.to_round(mesh);
  reference_.reset(new Reference{mesh, options, moments, frame, std::move(round_mesh), bounding_box(corners).diagonal(),
                                 moments.volume / hull_volume(corners), std::move(points),
                                 TriangleTree(std::move(triangles))});
}

ErrorMeasurement::~ErrorMeasurement() = default;

catalog::DecompositionError ErrorMeasurement::operator()(const std::vector<catalog::ConvexPart>& parts) const {
  const auto& [mesh, options, mesh_moments, frame, round_mesh, diagonal, convexity, mesh_points, mesh_tree] =
      *reference_;
  std::vector<catalog::TriangleMesh> hulls;
  std::vector<Vec3> corners;
  catalog::VolumeMoments moments;
  for (const catalog::ConvexPart& part : parts) {
    hulls.push_back(catalog::triangulated(part));
    moments += catalog::volume_moments(hulls.back());
    for (const catalog::Point& p : part.vertices) corners.push_back(to_vec3(p));
  }
  catalog::DecompositionError error;
  if (round_mesh) {
    for (catalog::TriangleMesh& hull : hulls) hull = frame.to_round(std::move(hull));
    measure_volumes(*round_mesh, hulls, options, catalog::volume_moments(*round_mesh).volume, error);
  } else
    measure_volumes(mesh, hulls, options, mesh_moments.volume, error);
  error.volume_error = moments.volume / mesh_moments.volume - 1;
  const auto centre = [](const catalog::VolumeMoments& of) { return 1 / of.volume * to_vec3(of.first); };
  error.centre_error = norm(centre(moments) - centre(mesh_moments)) / diagonal;
  const catalog::Matrix3 inertia = catalog::inertia_tensor(mesh_moments);
  error.inertia_error = norm_of(difference(catalog::inertia_tensor(moments), inertia)) / norm_of(inertia);
  // Facets of more than three corners come in triangles that no order of sums is the same for.
  error.convexity_error =
      std::round((moments.volume / (1 + error.overlap) / hull_volume(corners) - convexity) / kConvexityUnit) *
      kConvexityUnit;

  Random random(sub_seed(options.seed, kPartStream));
  const std::vector<double> from_mesh = distances_to_union(mesh_points, parts);
  const std::vector<double> from_union =
      distances_to_mesh(parts, mesh_tree, options.surface_samples, kCovered * diagonal, random);
  error.surface_from_mesh = summary(from_mesh, diagonal);
  error.surface_from_union = summary(from_union, diagonal);
  error.surface = summary(from_mesh, from_union, diagonal);
  return error;
}

catalog::DecompositionError measure_error(const catalog::TriangleMesh& mesh,
                                          const std::vector<catalog::ConvexPart>& parts,
                                          const QualityOptions& options) {
  return ErrorMeasurement(mesh, options)(parts);
}

}  // namespace decomposition
