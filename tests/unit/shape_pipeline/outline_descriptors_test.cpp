// SPDX-License-Identifier: GPL-3.0-or-later
// 2-D descriptors against closed forms.
#include "shape_pipeline/outline_descriptors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "catalog/input_error.h"

namespace shape_pipeline {
namespace {

constexpr double kPi = std::numbers::pi;

Outline ellipse(double a, double b, int corners) {
  Outline outline;
  for (int k = 0; k < corners; ++k)
    outline.push_back({a * std::cos(2 * kPi * k / corners), b * std::sin(2 * kPi * k / corners)});
  return outline;
}

Outline turned(Outline outline, double angle, double scale, PlanePoint shift) {
  for (PlanePoint& p : outline)
    p = {shift[0] + scale * (p[0] * std::cos(angle) - p[1] * std::sin(angle)),
         shift[1] + scale * (p[0] * std::sin(angle) + p[1] * std::cos(angle))};
  return outline;
}

/// A square of side 2 with rounded corners.
Outline rounded_square(double radius) {
  constexpr int kCorner = 60;
  Outline outline;
  for (int quarter = 0; quarter < 4; ++quarter)
    for (int k = 0; k <= kCorner; ++k) {
      const double angle = kPi / 2 * (quarter + static_cast<double>(k) / kCorner), middle = kPi / 2 * (quarter + 0.5);
      const double reach = (1 - radius) * std::numbers::sqrt2;
      outline.push_back(
          {reach * std::cos(middle) + radius * std::cos(angle), reach * std::sin(middle) + radius * std::sin(angle)});
    }
  return outline;
}

class Figures {
 public:
  explicit Figures(const Outline& outline) : list_(outline_descriptors(outline, 0)) {}
  double operator[](const std::string& name) const { return descriptor_value(list_, name); }

 private:
  std::vector<OutlineDescriptor> list_;
};

TEST(OutlineDescriptors, OfARectangleAreExact) {
  const Figures of(turned({{0, 0}, {3, 0}, {3, 1}, {0, 1}}, 0.3, 1, {5, -7}));
  constexpr double kExact = 1e-9;  // what the climb to the inscribed circle stops at; the rest is rounding
  EXPECT_NEAR(of["area_imagej"], 3, kExact);
  EXPECT_NEAR(of["perimeter_imagej"], 8, kExact);
  EXPECT_NEAR(of["circularity_4pi_area_over_perimeter2_imagej"], 12 * kPi / 64, kExact);
  EXPECT_NEAR(of["aspect_ratio_major_over_minor_imagej"], 3, kExact);
  EXPECT_NEAR(of["roundness_4area_over_pi_major2_imagej"], 1.0 / 3, kExact);
  EXPECT_NEAR(of["solidity_area_over_hull_imagej"], 1, kExact);
  EXPECT_NEAR(of["feret_max_imagej"], std::sqrt(10), kExact);
  EXPECT_NEAR(of["feret_min_imagej"], 1, kExact);
  // y runs down the image, so a turn from x to y is seen as clockwise; the two diagonals are equally long.
  EXPECT_NEAR(of["angle_ellipse_imagej"], 180 - 0.3 * 180 / kPi, 1e-6);
  EXPECT_NEAR(of["aspect_ratio_feret_min_over_max_iso"], 1 / std::sqrt(10), kExact);
  EXPECT_NEAR(of["ellipse_ratio_minor_over_major_iso"], 1.0 / 3, kExact);
  EXPECT_NEAR(of["extent_area_over_feret_product_iso"], 3 / std::sqrt(10), kExact);
  EXPECT_NEAR(of["box_ratio_area_over_least_box_iso"], 1, kExact);
  EXPECT_NEAR(of["convexity_hull_perimeter_over_perimeter_iso"], 1, kExact);
  EXPECT_NEAR(of["compactness_diameter_over_feret_max_iso"], std::sqrt(12 / kPi / 10), kExact);
  EXPECT_NEAR(of["straightness_feret_max_over_fibre_length_iso"], std::sqrt(10) / 3, kExact);
  EXPECT_NEAR(of["elongation_fibre_width_over_length_iso"], 1.0 / 3, kExact);
  EXPECT_NEAR(of["irregularity_inscribed_over_enclosing_iso"], 1 / std::sqrt(10), kExact);
  EXPECT_NEAR(of["robustness_inscribed_diameter_over_root_area_iso"], 1 / std::sqrt(3), kExact);
  EXPECT_EQ(of["concavity_pocket_diameter_over_root_area_iso"], 0);
  EXPECT_NEAR(of["sphericity_area_over_enclosing_circle"], 3 / (kPi * 2.5), kExact);
  EXPECT_NEAR(of["sphericity_perimeter_of_equal_circle"], std::sqrt(12 * kPi) / 8, kExact);
  EXPECT_NEAR(of["sphericity_width_over_length"], 6.0 / 10, kExact);  // 2 (3 * 1) / sqrt(10) across the diagonal
}

TEST(OutlineDescriptors, OfAnLHaveItsPocket) {
  const Figures of({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  EXPECT_NEAR(of["solidity_area_over_hull_imagej"], 3 / 3.5, 1e-12);
  EXPECT_NEAR(of["convexity_hull_perimeter_over_perimeter_iso"], (6 + std::sqrt(2)) / 8, 1e-12);
  // The circle in a right triangle with legs of 1.
  EXPECT_NEAR(of["concavity_pocket_diameter_over_root_area_iso"], (2 - std::sqrt(2)) / std::sqrt(3), 1e-6);
  // That in the L touches two outer sides and the inner corner: r sqrt(2) + r = sqrt(2).
  EXPECT_NEAR(of["radius_inscribed_circle"], std::sqrt(2) / (1 + std::sqrt(2)), 1e-6);
}

TEST(OutlineDescriptors, OfAnEllipseAreThoseOfItsFormula) {
  constexpr int kCorners = 4000;  // its polygon lacks (2 pi / n)^2 / 6 of the area
  constexpr double kPolygon = 1e-5;
  const Figures of(turned(ellipse(2, 1, kCorners), 1.1, 1e-4, {3e-3, 2e-3}));
  EXPECT_NEAR(of["area_imagej"] / (2e-8 * kPi), 1, kPolygon);
  // Ramanujan 1914, right to 1e-8 here.
  const double h = 1.0 / 9, round = kPi * 3 * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
  EXPECT_NEAR(of["perimeter_imagej"] / (1e-4 * round), 1, kPolygon);
  EXPECT_NEAR(of["aspect_ratio_major_over_minor_imagej"], 2, kPolygon);
  EXPECT_NEAR(of["roundness_4area_over_pi_major2_imagej"], 0.5, kPolygon);
  EXPECT_NEAR(of["feret_max_imagej"], 4e-4, 4e-4 * kPolygon);
  EXPECT_NEAR(of["feret_min_imagej"], 2e-4, 2e-4 * kPolygon);
  EXPECT_NEAR(of["feret_angle_imagej"], 180 - 1.1 * 180 / kPi, 1e-2);
  EXPECT_NEAR(of["sphericity_circle_ratio"], 0.5, kPolygon);
  EXPECT_NEAR(of["sphericity_diameter_over_enclosing_circle"], std::sqrt(0.5), kPolygon);
  EXPECT_TRUE(std::isnan(of["straightness_feret_max_over_fibre_length_iso"]));  // no rectangle is as round
}

TEST(OutlineDescriptors, WadellRoundnessOfRoundedSquaresAndEllipses) {
  // Smoothing over 1.5 % of the perimeter widens corners: most the sharpest.
  for (const double radius : {0.2, 0.4, 0.7})
    EXPECT_NEAR(Figures(rounded_square(radius))["roundness_wadell_zheng_hryciw"] / radius, 1, 0.05) << radius;
  EXPECT_EQ(Figures(ellipse(1, 1, 500))["roundness_wadell_zheng_hryciw"], 1);
  // The circle that just fits the tip has b^2 / a = 0.5 b; one inside to 2 % of its radius is a little larger.
  EXPECT_NEAR(Figures(ellipse(2, 1, 2000))["roundness_wadell_zheng_hryciw"], 0.5, 0.08);
}

TEST(OutlineDescriptors, DoNotDependOnSenseOrStart) {
  Outline outline = rounded_square(0.3);
  outline.push_back({1.5, -0.2});  // a spike, so that nothing is symmetric
  Outline other(outline.rbegin(), outline.rend());
  std::rotate(other.begin(), other.begin() + 17, other.end());
  const auto a = outline_descriptors(outline, 0), b = outline_descriptors(other, 0);
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::isnan(a[k].value)) continue;
    // The 720 points of the roundness lie elsewhere on the outline; all else is the same figure.
    const double tolerance = a[k].name == "roundness_wadell_zheng_hryciw" ? 0.02 : 1e-8;
    EXPECT_NEAR(a[k].value, b[k].value, tolerance * std::abs(a[k].value)) << a[k].name;
  }
}

TEST(OutlineDescriptors, RefuseWhatIsNoOutline) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Outline bad[] = {{}, {{0, 0}, {1, 0}}, {{0, 0}, {1, 1}, {2, 2}}, {{0, 0}, {1, 0}, {none, 1}}};
  for (const Outline& outline : bad) EXPECT_THROW(outline_descriptors(outline, 0), catalog::InputError);
}

}  // namespace
}  // namespace shape_pipeline
