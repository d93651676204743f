// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace catalog {

using Point = std::array<double, 3>;  // [m]
using Triangle = std::array<int, 3>;  // vertex indices, counter-clockwise seen from outside

/// Triangle mesh in metres; face normals point out of the solid.
struct TriangleMesh {
  std::vector<Point> vertices;  // n_vertices x 3 [m]
  std::vector<Triangle> faces;  // n_faces x 3, indices into vertices

  std::size_t vertex_count() const { return vertices.size(); }
  std::size_t face_count() const { return faces.size(); }
};

}  // namespace catalog
