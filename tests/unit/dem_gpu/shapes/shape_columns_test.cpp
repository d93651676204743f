// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/shapes/shape_columns.h"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/support/non_convex_bodies.h"

namespace {

using namespace test_support;
using dem_gpu::HostShapeColumns;

auto entries(const dem_gpu::ShapeRange& s) {
  return std::tuple(s.first_part, s.part_count, s.sphere_radius, s.bounding_radius, s.volume, s.equivalent_diameter,
                    s.inertia.x, s.inertia.y, s.inertia.z);
}
auto entries(const dem_gpu::PartRange& p) {
  return std::tuple(p.first_vertex, p.vertex_count, p.first_face, p.face_count, p.outer_face_count, p.first_depth_plane,
                    p.depth_plane_count, p.first_depth_term, p.depth_term_count, p.centre.x, p.centre.y, p.centre.z,
                    p.radius);
}
auto entries(const dem_gpu::LocalHalfSpace& h) { return std::tuple(h.normal.x, h.normal.y, h.normal.z, h.offset); }
auto entries(const dem_gpu::FaceCorners& f) { return std::tuple(f.first, f.count, f.vertices); }
auto entries(const dem_gpu::DepthTerm& t) { return std::tuple(t.first, t.count); }
auto entries(const dem_gpu::LocalVec3& v) { return std::tuple(v.x, v.y, v.z); }
auto entries(std::uint8_t corner) { return corner; }

template <class Entry>
void expect_same(const std::vector<Entry>& found, const std::vector<Entry>& expected, const char* column) {
  ASSERT_EQ(found.size(), expected.size()) << column;
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(entries(found[i]) == entries(expected[i])) << column << " " << i;
}

TEST(ShapeColumns, ChosenShapesAreThoseMadeAlone) {
  const dem_gpu::Shape box = box_shape({1, 2, 3}),
                       hexapod = dem_gpu::polyhedral_shape("hexapod", test_support::hexapod()),
                       ball = dem_gpu::sphere_shape("ball", 0.5);
  constexpr dem_gpu::Real kCap = 0.4;
  const HostShapeColumns all =
      dem_gpu::to_host(dem_gpu::make_shape_columns({box, ball, hexapod, box_shape({1, 1, 1})}, kCap));
  const HostShapeColumns chosen = dem_gpu::chosen_shapes(all, {2, 1, 0});
  const HostShapeColumns alone = dem_gpu::make_host_shape_columns({hexapod, ball, box}, kCap);
  EXPECT_GT(alone.depth_terms.size(), 0u);
  expect_same(chosen.shapes, alone.shapes, "shapes");
  expect_same(chosen.parts, alone.parts, "parts");
  expect_same(chosen.vertices, alone.vertices, "vertices");
  expect_same(chosen.planes, alone.planes, "planes");
  expect_same(chosen.faces, alone.faces, "faces");
  expect_same(chosen.corners, alone.corners, "corners");
  expect_same(chosen.depth_planes, alone.depth_planes, "depth planes");
  expect_same(chosen.depth_terms, alone.depth_terms, "depth terms");
  expect_same(chosen.term_planes, alone.term_planes, "term planes");
}

}  // namespace
