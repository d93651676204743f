// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/grain_pictures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shape_pipeline/digitization.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/surfaces/vector3.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace shape_pipeline;
using test_support::uv_sphere;

TEST(DeviationMap, HasTheDistanceAndItsSign) {
  const catalog::TriangleMesh source = uv_sphere(1, 60);
  for (const double growth : {0.01, -0.01}) {
    const DeviationMap map = deviation_from_mesh(uv_sphere(1 + growth, 60), source);
    EXPECT_EQ(map.share_without, 0);
    // Facets of 3 degrees lie up to 1 - cos(1.5 degrees) = 3.4e-4 within their ball.
    EXPECT_NEAR(map.all.mean, 0.01, 4e-4);
    EXPECT_NEAR(map.all.largest, 0.01, 8e-4);
    for (const double value : map.values) EXPECT_GT(value * growth, 0);
  }
}

TEST(DeviationMap, HasNoValueWhereTheSourceHasAGap) {
  std::vector<Point> points;
  for (const Point& p : uv_sphere(1, 60).vertices)
    if (p[2] < 0.5) points.push_back(p);
  const catalog::TriangleMesh whole = uv_sphere(1, 40);
  const DeviationMap map = deviation_from_points(whole, points);
  for (std::size_t v = 0; v < whole.vertices.size(); ++v) {
    const double height = whole.vertices[v][2], value = map.values[v];
    EXPECT_TRUE(height < 0.8 || std::isnan(value));
    EXPECT_TRUE(height > 0.45 || std::abs(value) < 2e-3) << value << ", facets of 4.5 degrees";
  }
  // The vertices stand in rings of even steps of latitude; the gap reaches to 60 of 180 degrees, less four spacings of
  // the points, which are up to 3 degrees apart.
  EXPECT_LT(map.share_without, 60.0 / 180);
  EXPECT_GT(map.share_without, (60.0 - 4 * 3) / 180 - 0.03);
}

TEST(SourceFrame, LeadsBackToTheScanThoughItWasTurnedShiftedAndRescaled) {
  const test_support::TemporaryFolder folder;
  const catalog::TriangleMesh scan =
      test_support::moved(test_support::box_mesh({0, 0, 0}, {1, 3, 2}), 10, {400, -70, 30});  // [mm]
  write_stl(folder / "box.stl", scan);
  DigitizationOptions options;
  options.metres_per_unit = 1e-3;
  options.sieve_size = 0.05;
  const catalog::ShapeRecord shape = digitize(folder / "box.stl", options);
  ASSERT_TRUE(shape.source_frame);
  EXPECT_NEAR(shape.source_frame->scale, 2.5, 1e-5);  // 20 mm to 50 mm, in single precision about 400 mm
  const std::vector<Point> there = in_source_frame(*shape.source_frame, shape.mesh.vertices);
  // STL holds single precision: 400 mm to 3e-5 mm.
  for (const Point& vertex : there) {
    double nearest = 1;
    for (const Point& corner : scan.vertices) nearest = std::min(nearest, distance(vertex, scaled(corner, 1e-3)));
    EXPECT_LT(nearest, 1e-7);
  }
  const std::vector<Point> back = in_shape_frame(*shape.source_frame, there);
  for (std::size_t v = 0; v < back.size(); ++v) EXPECT_LT(distance(back[v], shape.mesh.vertices[v]), 1e-12);
  const DeviationMap map = deviation_from_mesh(
      shape.mesh, {in_shape_frame(*shape.source_frame, read_mesh(folder / "box.stl", 1e-3).vertices),
                   read_mesh(folder / "box.stl", 1e-3).faces});
  EXPECT_LT(map.all.largest, 1e-7);
}

/// Share of the pixels that are not white.
double covered(const ColourImage& image) {
  double count = 0;
  for (const Colour& pixel : image.pixels) count += pixel != Colour{255, 255, 255} ? 1 : 0;
  return count / static_cast<double>(image.pixels.size());
}

TEST(GrainPictures, ABallFillsItsDiscOnBothSidesAndInsidesAreOrange) {
  catalog::TriangleMesh ball = uv_sphere(1, 40);
  const GrainView view = view_of(ball.vertices, 100);
  EXPECT_NEAR(view.radius, 1, 1e-12);
  const ColourImage outside = drawn_surface(ball, view);
  EXPECT_EQ(outside.width, 200);
  EXPECT_EQ(outside.height, 100);
  // A disc of radius side / (2 * 1.04), and the rim's pixels that are partly covered.
  EXPECT_NEAR(covered(outside), 3.14159 / 4 / (1.04 * 1.04), 0.03);
  for (catalog::Triangle& face : ball.faces) std::swap(face[0], face[1]);
  const ColourImage inside = drawn_surface(ball, view);
  const Colour stone = outside(50, 50), orange = inside(50, 50);
  EXPECT_LT(stone[0] - stone[2], 40);
  EXPECT_GT(orange[0] - orange[2], 80);
  // Dots about half as far apart as their size at the poles of the ball, where its points lie dense, and as far at its
  // equator: most of the disc.
  EXPECT_GT(covered(drawn_points(ball.vertices, view)), 0.6 * covered(outside));
  EXPECT_LT(covered(drawn_points(ball.vertices, view)), 1.2 * covered(outside));
}

TEST(GrainPictures, AMapIsRedOutsideBlueInsideAndGreyWhereThereIsNoValue) {
  const catalog::TriangleMesh ball = uv_sphere(1, 20);
  const GrainView view = view_of(ball.vertices, 60);
  const auto middle = [&](double value) {
    return drawn_map(ball, std::vector<double>(ball.vertices.size(), value), 0.01, view)(30, 30);
  };
  EXPECT_GT(middle(0.01)[0], middle(0.01)[2] + 80);
  EXPECT_GT(middle(-0.01)[2], middle(-0.01)[0] + 80);
  const Colour none = middle(std::nan("")), zero = middle(0);
  EXPECT_EQ(none[0], none[2]);
  EXPECT_GT(zero[0], none[0] + 40);
  EXPECT_EQ(middle(5), middle(0.01)) << "beyond the scale";
}

}  // namespace
