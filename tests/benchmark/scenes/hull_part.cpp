// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/scenes/hull_part.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace benchmark_scenes {
namespace {

using catalog::ConvexFace;
using catalog::ConvexPart;
using dem_gpu::Vec3;

/// Of the size of the points: nearer than this to a plane a point lies on it.
constexpr double kFlat = 1e-10;

double size_of(const std::vector<Vec3>& points) {
  double size = 0;
  for (const Vec3& p : points) size = std::max(size, norm(p - points.front()));
  return size;
}

/// Corners of a face counter-clockwise as seen from outside, those on its edges left out.
std::vector<int> outline(const std::vector<Vec3>& points, std::vector<int> on_plane, const Vec3& normal) {
  Vec3 middle;
  for (const int v : on_plane) middle += points[v] / static_cast<double>(on_plane.size());
  Vec3 first = points[on_plane.front()] - middle;
  first = first / norm(first);
  const Vec3 second = cross(normal, first);
  const auto angle = [&](int v) { return std::atan2(dot(points[v] - middle, second), dot(points[v] - middle, first)); };
  std::sort(on_plane.begin(), on_plane.end(), [&](int a, int b) { return angle(a) < angle(b); });
  std::vector<int> corners;
  const std::size_t n = on_plane.size();
  for (std::size_t c = 0; c < n; ++c) {
    const Vec3 before = points[on_plane[(c + n - 1) % n]], here = points[on_plane[c]],
               after = points[on_plane[(c + 1) % n]];
    if (dot(cross(here - before, after - here), normal) > kFlat * norm(here - before) * norm(after - here))
      corners.push_back(on_plane[c]);
  }
  return corners;
}

/// The face through three points if all others lie behind it.
std::optional<ConvexFace> face_through(const std::vector<Vec3>& points, int i, int j, int k) {
  Vec3 normal = cross(points[j] - points[i], points[k] - points[i]);
  const double size = size_of(points);
  if (norm(normal) < kFlat * size * size) return std::nullopt;
  normal = normal / norm(normal);
  double above = 0, below = 0;
  std::vector<int> on_plane;
  for (int v = 0; v < static_cast<int>(points.size()); ++v) {
    const double height = dot(points[v] - points[i], normal);
    if (std::abs(height) <= kFlat * size) on_plane.push_back(v);
    above = std::max(above, height);
    below = std::min(below, height);
  }
  if (above > kFlat * size && below < -kFlat * size) return std::nullopt;
  if (above > kFlat * size) normal = -normal;
  return ConvexFace{outline(points, on_plane, normal),
                    {{normal.x, normal.y, normal.z}, dot(normal, points[i])},
                    catalog::FaceKind::outer};
}

/// Two faces of a convex body never have one normal.
bool is_among(const std::vector<ConvexFace>& faces, const ConvexFace& face) {
  return std::any_of(faces.begin(), faces.end(), [&](const ConvexFace& other) {
    const catalog::Point &a = face.plane.normal, &b = other.plane.normal;
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 1 - kFlat;
  });
}

/// Leaves out the vertices of no face.
ConvexPart compacted(const std::vector<Vec3>& points, std::vector<ConvexFace> faces) {
  ConvexPart part;
  std::vector<int> renamed(points.size(), -1);
  for (ConvexFace& face : faces)
    for (int& v : face.vertices) {
      if (renamed[v] < 0) {
        renamed[v] = static_cast<int>(part.vertices.size());
        part.vertices.push_back({points[v].x, points[v].y, points[v].z});
      }
      v = renamed[v];
    }
  part.faces = std::move(faces);
  return part;
}

}  // namespace

ConvexPart hull_part(const std::vector<Vec3>& points) {
  std::vector<ConvexFace> faces;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k)
        if (std::optional<ConvexFace> face = face_through(points, i, j, k); face && !is_among(faces, *face))
          faces.push_back(std::move(*face));
  return compacted(points, std::move(faces));
}

ConvexPart box_between(const Vec3& low, const Vec3& high) {
  ConvexPart part = dem_gpu::box_part(high - low);
  const Vec3 centre = 0.5 * (low + high);
  for (catalog::Point& vertex : part.vertices)
    vertex = {vertex[0] + centre.x, vertex[1] + centre.y, vertex[2] + centre.z};
  for (ConvexFace& face : part.faces)
    face.plane.offset += dot(Vec3{face.plane.normal[0], face.plane.normal[1], face.plane.normal[2]}, centre);
  return part;
}

ConvexFace& face_towards(ConvexPart& part, const Vec3& direction) {
  return *std::max_element(part.faces.begin(), part.faces.end(), [&](const ConvexFace& a, const ConvexFace& b) {
    const auto along = [&](const ConvexFace& face) {
      return dot(Vec3{face.plane.normal[0], face.plane.normal[1], face.plane.normal[2]}, direction);
    };
    return along(a) < along(b);
  });
}

}  // namespace benchmark_scenes
