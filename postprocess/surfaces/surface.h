// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dem_gpu/snapshot.h"

namespace postprocess {

/// Polygon mesh in metres.
struct Surface {
  std::vector<dem_gpu::Vec3> points;  // [m]
  std::vector<int> corners;           // indices into points, polygon after polygon
  std::vector<int> polygon_end;       // polygon p ends before corners[polygon_end[p]]

  int polygon_count() const { return static_cast<int>(polygon_end.size()); }
  int polygon_begin(int polygon) const { return polygon == 0 ? 0 : polygon_end[polygon - 1]; }
  void add_polygon(const std::vector<int>& indices);
};

/// Sphere of radius 1 about the origin: an icosahedron, each edge halved `levels` times; 20 * 4^levels triangles.
Surface unit_sphere(int levels);

/// Surface of a shape at scale 1 in its body frame: the faces of its parts (those inside included: where two parts meet
/// one may be larger than the other), or a sphere.
Surface shape_surface(const dem_gpu::ShapeGeometry& shape, int sphere_levels);

/// x -> rotation * (scale * x) + translation.
struct Placement {
  dem_gpu::Quaternion rotation;
  dem_gpu::Vec3 translation;
  double scale = 1;
};

/// Appends `part`, placed; returns the range of polygons it became.
std::pair<int, int> append(Surface& surface, const Surface& part, const Placement& placement);

/// Axis-aligned box.
struct Bounds {
  dem_gpu::Vec3 low{1, 1, 1};
  dem_gpu::Vec3 high{-1, -1, -1};

  bool is_empty() const { return low.x > high.x; }
  void include(const dem_gpu::Vec3& point);
  dem_gpu::Vec3 middle() const { return 0.5 * (low + high); }
  double diagonal() const { return is_empty() ? 0 : dem_gpu::norm(high - low); }
};

/// Box of the active bodies (by bounding spheres) and of all walls but planes, at the snapshot's time.
Bounds scene_bounds(const dem_gpu::RunGeometry& geometry, const dem_gpu::Snapshot& snapshot);

/// Surface of a wall at time 0; a plane becomes the part of it that lies in `bounds`, made a little larger.
Surface wall_surface(const dem_gpu::WallGeometry& wall, const Bounds& bounds, int segments = 96);

/// Where a wall is at the snapshot's time.
Placement wall_placement(const dem_gpu::Snapshot& snapshot, int wall);
Placement body_placement(const dem_gpu::RunGeometry& geometry, const dem_gpu::Snapshot& snapshot, int body);

/// Radius about the body frame's origin that holds a shape at scale 1 [m].
double bounding_radius(const dem_gpu::ShapeGeometry& shape);

}  // namespace postprocess
