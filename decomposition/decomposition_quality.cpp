// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/decomposition_quality.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "catalog/mass_properties.h"
#include "decomposition/geometry/faceted_hull.h"
#include "decomposition/geometry/random.h"
#include "decomposition/quality/ray_volumes.h"
#include "decomposition/quality/surface_distance.h"
#include "decomposition/solid/surface_pieces.h"

namespace decomposition {
namespace {

// Share of the diagonal: a sample point this deep in another part, or on its surface, is covered by it.
constexpr double kCovered = 1e-9;
// Streams of random numbers beside those of the ray sets, which count from 0.
constexpr std::uint64_t kMeshStream = 1000, kPartStream = 1001;

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
  std::vector<catalog::TriangleMesh> bodies;  // see separate_bodies()
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
  reference_.reset(new Reference{mesh, options, moments, separate_bodies(mesh), bounding_box(corners).diagonal(),
                                 moments.volume / hull_volume(corners), std::move(points),
                                 TriangleTree(std::move(triangles))});
}

ErrorMeasurement::~ErrorMeasurement() = default;

catalog::DecompositionError ErrorMeasurement::operator()(const std::vector<catalog::ConvexPart>& parts) const {
  const auto& [mesh, options, mesh_moments, bodies, diagonal, convexity, mesh_points, mesh_tree] = *reference_;
  std::vector<catalog::TriangleMesh> hulls;
  std::vector<Vec3> corners;
  catalog::VolumeMoments moments;
  for (const catalog::ConvexPart& part : parts) {
    hulls.push_back(catalog::triangulated(part));
    moments += catalog::volume_moments(hulls.back());
    for (const catalog::Point& p : part.vertices) corners.push_back(to_vec3(p));
  }
  catalog::DecompositionError error;
  const RayVolumes volumes = ray_volumes(mesh, bodies, hulls, options);
  error.symmetric_difference = volumes.symmetric_difference;
  error.method_error = volumes.method_error;
  error.missing_volume = volumes.missing_volume;
  error.overlap = volumes.overlap;
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
