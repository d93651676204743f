// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/outline_descriptors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "catalog/input_error.h"
#include "shape_pipeline/micrographs/plane_geometry.h"
#include "shape_pipeline/micrographs/wadell_roundness.h"
#include "shape_pipeline/surfaces/enclosing_sphere.h"

namespace shape_pipeline {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCircleTolerance = 2e-3;  // of the root of the area, before climbing
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What the formulas are made of; lengths in the outline's unit.
struct Measures {
  double area = 0, perimeter = 0, hull_area = 0, hull_perimeter = 0;
  FittedEllipse ellipse;
  Calipers calipers;
  double inscribed = 0, enclosing = 0;  // radii
  double largest_pocket = 0;            // radius of the largest circle between outline and hull
};

void require_outline(const Outline& outline) {
  const auto is_finite = [](const PlanePoint& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); };
  if (outline.size() < 3 || !std::all_of(outline.begin(), outline.end(), is_finite) || plane_moments(outline).area == 0)
    throw catalog::InputError("outline: expected three or more corners about an area, in finite numbers; draw it anew");
}

/// Pockets narrower than the tolerance count as none.
double largest_pocket_radius(const Outline& outline, double tolerance) {
  double largest = tolerance;
  for (const Outline& pocket : hull_pockets(outline)) {
    // A circle in a pocket is at most as wide as the pocket: most need no search.
    const Outline hull = plane_hull(pocket);
    if (hull.size() < 3 || calipers(hull).feret_min / 2 <= largest) continue;
    largest = std::max(largest, inscribed_circle_radius(pocket, tolerance));
  }
  return largest > tolerance ? largest : 0;
}

Measures measured(const Outline& outline) {
  const Outline hull = plane_hull(outline);
  const PlaneMoments moments = plane_moments(outline);
  Measures m;
  m.area = std::abs(moments.area);
  m.perimeter = perimeter(outline);
  m.hull_area = plane_moments(hull).area;
  m.hull_perimeter = perimeter(hull);
  m.ellipse = fitted_ellipse(moments);
  m.calipers = calipers(hull);
  const double tolerance = kCircleTolerance * std::sqrt(m.area);
  m.inscribed = inscribed_circle_radius(outline, tolerance);
  std::vector<catalog::Point> flat;
  for (const PlanePoint& p : hull) flat.push_back({p[0], p[1], 0});
  m.enclosing = enclosing_radius(flat);
  m.largest_pocket = largest_pocket_radius(outline, tolerance);
  return m;
}

/// Degrees from the image's x axis counter-clockwise as seen, 0 to 180, of a direction with y down the image.
double seen_degrees(double angle) {
  const double degrees = std::fmod(360 - angle * 180 / kPi, 180);
  return degrees < 180 ? degrees : 0;
}

/// Length and width of the rectangle of the same area and perimeter (ISO 9276-6, for fibres); only thin ones have one.
std::array<double, 2> fibre_sides(const Measures& m) {
  const double square = std::pow(m.perimeter / 4, 2) - m.area;
  if (square < 0) return {kNone, kNone};
  return {m.perimeter / 4 + std::sqrt(square), m.perimeter / 4 - std::sqrt(square)};
}

void add_imagej(const Measures& m, std::vector<OutlineDescriptor>& list) {
  list.push_back({"area_imagej", "m2", m.area});
  list.push_back({"perimeter_imagej", "m", m.perimeter});
  list.push_back({"major_ellipse_imagej", "m", m.ellipse.major});
  list.push_back({"minor_ellipse_imagej", "m", m.ellipse.minor});
  list.push_back({"angle_ellipse_imagej", "deg", seen_degrees(m.ellipse.angle)});
  list.push_back({"circularity_4pi_area_over_perimeter2_imagej", "-", 4 * kPi * m.area / (m.perimeter * m.perimeter)});
  list.push_back({"aspect_ratio_major_over_minor_imagej", "-", m.ellipse.major / m.ellipse.minor});
  list.push_back(
      {"roundness_4area_over_pi_major2_imagej", "-", 4 * m.area / (kPi * m.ellipse.major * m.ellipse.major)});
  list.push_back({"solidity_area_over_hull_imagej", "-", m.area / m.hull_area});
  list.push_back({"feret_max_imagej", "m", m.calipers.feret_max});
  list.push_back({"feret_min_imagej", "m", m.calipers.feret_min});
  list.push_back({"feret_angle_imagej", "deg", seen_degrees(m.calipers.feret_max_angle)});
}

void add_iso_9276_6(const Measures& m, std::vector<OutlineDescriptor>& list) {
  const double diameter = std::sqrt(4 * m.area / kPi);
  const Calipers& c = m.calipers;
  const auto [fibre_length, fibre_width] = fibre_sides(m);
  list.push_back({"equivalent_diameter_area", "m", diameter});
  list.push_back({"equivalent_diameter_perimeter", "m", m.perimeter / kPi});
  list.push_back({"aspect_ratio_feret_min_over_max_iso", "-", c.feret_min / c.feret_max});
  list.push_back({"ellipse_ratio_minor_over_major_iso", "-", m.ellipse.minor / m.ellipse.major});
  list.push_back({"circularity_root_4pi_area_over_perimeter_iso", "-", std::sqrt(4 * kPi * m.area) / m.perimeter});
  list.push_back({"convexity_hull_perimeter_over_perimeter_iso", "-", m.hull_perimeter / m.perimeter});
  list.push_back({"compactness_diameter_over_feret_max_iso", "-", diameter / c.feret_max});
  list.push_back({"extent_area_over_feret_product_iso", "-", m.area / (c.feret_min * c.feret_max)});
  list.push_back({"box_ratio_area_over_least_box_iso", "-", m.area / c.box_area});
  list.push_back({"irregularity_inscribed_over_enclosing_iso", "-", m.inscribed / m.enclosing});
  list.push_back({"straightness_feret_max_over_fibre_length_iso", "-", c.feret_max / fibre_length});
  list.push_back({"elongation_fibre_width_over_length_iso", "-", fibre_width / fibre_length});
  list.push_back({"robustness_inscribed_diameter_over_root_area_iso", "-", 2 * m.inscribed / std::sqrt(m.area)});
  list.push_back({"concavity_pocket_diameter_over_root_area_iso", "-", 2 * m.largest_pocket / std::sqrt(m.area)});
}

void add_sphericities(const Measures& m, std::vector<OutlineDescriptor>& list) {
  const double radius = std::sqrt(m.area / kPi);
  list.push_back({"radius_inscribed_circle", "m", m.inscribed});
  list.push_back({"radius_enclosing_circle", "m", m.enclosing});
  list.push_back({"sphericity_area_over_enclosing_circle", "-", m.area / (kPi * m.enclosing * m.enclosing)});
  list.push_back({"sphericity_diameter_over_enclosing_circle", "-", radius / m.enclosing});
  list.push_back({"sphericity_circle_ratio", "-", m.inscribed / m.enclosing});
  list.push_back({"sphericity_perimeter_of_equal_circle", "-", 2 * kPi * radius / m.perimeter});
  list.push_back({"sphericity_width_over_length", "-", m.calipers.across_max / m.calipers.feret_max});
}

}  // namespace

std::vector<OutlineDescriptor> outline_descriptors(const Outline& outline, double pixel) {
  require_outline(outline);
  const Measures m = measured(outline);
  std::vector<OutlineDescriptor> list;
  add_imagej(m, list);
  add_iso_9276_6(m, list);
  add_sphericities(m, list);
  list.push_back({"roundness_wadell_zheng_hryciw", "-", wadell_roundness(outline, m.inscribed, pixel)});
  return list;
}

double descriptor_value(const std::vector<OutlineDescriptor>& descriptors, const std::string& name) {
  for (const OutlineDescriptor& descriptor : descriptors)
    if (descriptor.name == name) return descriptor.value;
  return kNone;
}

OutlineForm outline_form(const Outline& outline) {
  require_outline(outline);
  const PlaneMoments moments = plane_moments(outline);
  const FittedEllipse ellipse = fitted_ellipse(moments);
  const double area = std::abs(moments.area);
  return {std::sqrt(4 * area / kPi), ellipse.minor / ellipse.major, area / plane_moments(plane_hull(outline)).area,
          4 * kPi * area / std::pow(perimeter(outline), 2)};
}

}  // namespace shape_pipeline
