// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "catalog/shape_record.h"

namespace test_support {

/// Closed box from the origin's `low` corner to `high`, outward normals.
inline catalog::TriangleMesh box_mesh(const catalog::Point& low, const catalog::Point& high) {
  catalog::TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back(
        {corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1], corner & 4 ? high[2] : low[2]});
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// The same box as a convex part; its face towards +x is inner when `inner_right`.
inline catalog::ConvexPart box_part(const catalog::Point& low, const catalog::Point& high, bool inner_right = false) {
  catalog::ConvexPart part;
  part.vertices = box_mesh(low, high).vertices;
  const auto face = [&](std::vector<int> corners, catalog::Point normal, double offset) {
    part.faces.push_back({std::move(corners), {normal, offset}, catalog::FaceKind::outer});
  };
  face({0, 4, 6, 2}, {-1, 0, 0}, -low[0]);
  face({1, 3, 7, 5}, {1, 0, 0}, high[0]);
  face({0, 1, 5, 4}, {0, -1, 0}, -low[1]);
  face({2, 6, 7, 3}, {0, 1, 0}, high[1]);
  face({0, 2, 3, 1}, {0, 0, -1}, -low[2]);
  face({4, 5, 7, 6}, {0, 0, 1}, high[2]);
  if (inner_right) part.faces[1].kind = catalog::FaceKind::inner;
  return part;
}

/// A box shape of 2 x 1.2 x 1 mm times `scale`, with every field filled in.
inline catalog::ShapeRecord sample_shape(const std::string& name, double scale = 1) {
  catalog::ShapeRecord shape;
  shape.name = name;
  const double x = 1e-3 * scale, y = 0.6e-3 * scale, z = 0.5e-3 * scale;
  shape.mesh = box_mesh({-x, -y, -z}, {x, y, z});
  shape.mass_properties = mass_properties(shape.mesh);
  shape.descriptors = {{"sphericity_wadell", 0.1 + 0.2 * scale}, {"flatness_kong_fonseca", 1.0 / 3.0 * scale}};
  shape.provenance = {name + ".ply", std::string(64, 'a'), "talus 0.1.0", R"({"unit":"mm"})"};
  shape.checks = {{"closed", true, 0, "boundary edges, expected 0"},
                  {"volume_second_method", scale > 2, 0.013, "relative difference, expected below 0.01 [-]"}};
  return shape;
}

/// Two touching halves of sample_shape's box; `vertex_cap` 64.
inline catalog::LevelOfDetail sample_level(const catalog::ShapeRecord& shape, int parts_asked) {
  catalog::LevelOfDetail level;
  level.key.parts_asked = parts_asked;
  level.key.vertex_cap = 64;
  const catalog::Point low = shape.mesh.vertices.front(), high = shape.mesh.vertices.back();
  level.parts = {box_part(low, {0, high[1], high[2]}, true), box_part({0, low[1], low[2]}, high)};
  level.mass_properties = shape.mass_properties;
  level.error = {.symmetric_difference = 1.0 / 7,
                 .method_error = 1e-5,
                 .missing_volume = 0.01,
                 .volume_error = -0.003,
                 .surface_from_mesh = {1e-3 / 7, 2e-3 / 3, 0.01},
                 .surface_from_union = {1e-3 / 5, 3e-3, 0.02},
                 .surface = {1e-3 / 3, 2e-3, 0.02},
                 .centre_error = 4e-4,
                 .inertia_error = 5e-3,
                 .convexity_error = -0.06};
  level.provenance = {shape.name, std::string(64, 'b'), "talus 0.1.0", R"({"parts":[2]})"};
  return level;
}

}  // namespace test_support
