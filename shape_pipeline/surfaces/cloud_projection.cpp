// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/cloud_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape_pipeline/surface_distance.h"
#include "shape_pipeline/surfaces/nearest_points.h"
#include "shape_pipeline/surfaces/vector3.h"
#include "shape_pipeline/surfaces/winding_volume.h"

namespace shape_pipeline {
namespace {

constexpr int kNeighbours = 12;       // points that pull at a vertex
constexpr int kPasses = 3;            // the shift falls below a hundredth of the first after three
constexpr double kWeightWidth = 1;    // Gaussian width / spacing: narrower follows noise, wider rounds edges
constexpr double kTrustedNear = 2;    // nearest point / spacing up to which the cloud is followed fully
constexpr double kTrustedFar = 4;     // and from which it is not followed at all
constexpr double kLargestShift = 1;   // of a vertex in one pass / spacing
constexpr double kStrayDistance = 3;  // from the surface / spacing: beyond, a point says nothing about it
constexpr int kAllElements = std::numeric_limits<int>::max();

std::vector<Point> vertex_normals(const catalog::TriangleMesh& mesh) {
  std::vector<Point> normals(mesh.vertices.size(), Point{});
  for (const catalog::Triangle& face : mesh.faces) {
    const Point& origin = mesh.vertices[face[0]];
    const Point area = cross(subtract(mesh.vertices[face[1]], origin), subtract(mesh.vertices[face[2]], origin));
    for (const int v : face) normals[v] = add(normals[v], area);
  }
  for (Point& normal : normals) normal = normalized(normal);
  return normals;
}

/// Signed way [m] of a vertex along its normal to the cloud.
double shift_to_cloud(const Point& vertex, const Point& normal, const PointCloud& cloud,
                      const std::vector<int>& neighbours, double spacing) {
  double weight_sum = 0, weighted_way = 0;
  for (const int n : neighbours) {
    const double agreement = dot(normal, cloud.normals[n]);
    if (agreement <= 0) continue;  // the far side of a thin part
    const Point way = subtract(cloud.points[n], vertex);
    const double reach = norm(way) / (kWeightWidth * spacing);
    const double weight = agreement * std::exp(-reach * reach);
    weight_sum += weight;
    weighted_way += weight * dot(scaled(add(normal, cloud.normals[n]), 0.5), way);
  }
  if (!(weight_sum > 0)) return 0;
  const double nearest = distance(vertex, cloud.points[neighbours.front()]) / spacing;
  const double trust = std::clamp((kTrustedFar - nearest) / (kTrustedFar - kTrustedNear), 0.0, 1.0);
  return trust * std::clamp(weighted_way / weight_sum, -kLargestShift * spacing, kLargestShift * spacing);
}

}  // namespace

catalog::TriangleMesh projected_to_cloud(const catalog::TriangleMesh& mesh, const PointCloud& cloud, double spacing) {
  catalog::TriangleMesh result = mesh;
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<Point> normals = vertex_normals(result);
    const auto neighbours = nearest_points(cloud.points, result.vertices, kNeighbours);
    for (std::size_t v = 0; v < result.vertices.size(); ++v) {
      const double shift = shift_to_cloud(result.vertices[v], normals[v], cloud, neighbours[v], spacing);
      result.vertices[v] = add(result.vertices[v], scaled(normals[v], shift));
    }
  }
  return result;
}

catalog::TriangleMesh balanced_on_cloud(const catalog::TriangleMesh& mesh, const PointCloud& cloud, double spacing) {
  if (mesh.faces.empty()) return mesh;
  const std::vector<SurfaceElement> elements = surface_elements(cloud, kAllElements);
  const std::vector<double> distances = signed_distances_to_surface(cloud.points, mesh);
  double area_sum = 0, weighted_distance = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (std::abs(distances[i]) > kStrayDistance * spacing) continue;
    const double area = norm(elements[i].area);
    area_sum += area;
    weighted_distance += area * distances[i];
  }
  if (!(area_sum > 0)) return mesh;
  catalog::TriangleMesh result = mesh;
  const std::vector<Point> normals = vertex_normals(mesh);
  for (std::size_t v = 0; v < result.vertices.size(); ++v)
    result.vertices[v] = add(result.vertices[v], scaled(normals[v], weighted_distance / area_sum));
  return result;
}

}  // namespace shape_pipeline
