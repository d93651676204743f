// SPDX-License-Identifier: Apache-2.0
#include "workflows/fill.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "catalog/input_error.h"
#include "workflows/random_stream.h"

namespace workflows {
namespace {

// More cells than this are a slip in a unit, not a fill.
constexpr double kMostCells = 5e7;
// Cells may pass the region's surface by this share of their size: rounding of a lattice that fits exactly.
constexpr double kFitTolerance = 1e-9;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point plus(const Point& a, double s, const Point& b) { return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point centre_of(const FillRegion& region) {
  if (const auto* cylinder = std::get_if<CylinderRegion>(&region))
    return plus(cylinder->base, cylinder->length / 2, cylinder->axis);
  const auto& box = std::get<BoxRegion>(region);
  return {(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2, (box.low[2] + box.high[2]) / 2};
}

/// Half the region's extent along a unit direction [m].
double half_extent(const FillRegion& region, const Point& direction) {
  if (const auto* cylinder = std::get_if<CylinderRegion>(&region)) {
    const double along = std::abs(dot(cylinder->axis, direction));
    return cylinder->length / 2 * along + cylinder->radius * std::sqrt(std::max(0.0, 1 - along * along));
  }
  const auto& box = std::get<BoxRegion>(region);
  double extent = 0;
  for (int i = 0; i < 3; ++i) extent += std::abs(direction[i]) * (box.high[i] - box.low[i]) / 2;
  return extent;
}

Point any_perpendicular(const Point& n) {
  const Point trial = std::abs(n[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  Point side = minus(trial, {dot(trial, n) * n[0], dot(trial, n) * n[1], dot(trial, n) * n[2]});
  const double length = std::sqrt(dot(side, side));
  for (double& component : side) component /= length;
  return side;
}

/// Steps between neighbours, in units of the spacing. Hexagonal: rows and layers of the close-packed ABAB stacking.
struct LatticeSteps {
  double row, layer;                                 // between rows of a layer, between layers
  double row_shift;                                  // of every second row along the row
  double layer_shift_along_row, layer_shift_across;  // of every second layer
};

LatticeSteps steps_of(Lattice lattice) {
  if (lattice == Lattice::cubic) return {1, 1, 0, 0, 0};
  return {std::numbers::sqrt3 / 2, std::numbers::sqrt2 / std::numbers::sqrt3, 0.5, 0.5, 0.5 / std::numbers::sqrt3};
}

struct Cell {
  Point centre;
  long off_axis;  // squared distance from the layer's middle, in 1e-6 of the spacing squared: equal for mirror images
};

std::string millimetres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", length * 1e3);
  return text;
}

}  // namespace

bool contains_ball(const FillRegion& region, const Point& centre, double radius) {
  const double slack = kFitTolerance * radius;
  if (const auto* cylinder = std::get_if<CylinderRegion>(&region)) {
    const Point from_base = minus(centre, cylinder->base);
    const double along = dot(from_base, cylinder->axis);
    const double off_axis = std::sqrt(std::max(0.0, dot(from_base, from_base) - along * along));
    return along >= radius - slack && along <= cylinder->length - radius + slack &&
           off_axis <= cylinder->radius - radius + slack;
  }
  const auto& box = std::get<BoxRegion>(region);
  for (int i = 0; i < 3; ++i)
    if (centre[i] < box.low[i] + radius - slack || centre[i] > box.high[i] - radius + slack) return false;
  return true;
}

double volume(const FillRegion& region) {
  if (const auto* cylinder = std::get_if<CylinderRegion>(&region))
    return std::numbers::pi * cylinder->radius * cylinder->radius * cylinder->length;
  const auto& box = std::get<BoxRegion>(region);
  return (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]) * (box.high[2] - box.low[2]);
}

std::vector<Point> lattice_cells(const FillRegion& region, Lattice lattice, double spacing, const Point& up) {
  const LatticeSteps step = steps_of(lattice);
  const Point along = any_perpendicular(up), across = cross(up, along);
  const Point centre = centre_of(region);
  const double half_height = half_extent(region, up);
  const int most_along = static_cast<int>(half_extent(region, along) / spacing) + 2;
  const int most_across = static_cast<int>(half_extent(region, across) / (step.row * spacing)) + 2;

  std::vector<Point> cells;
  for (int layer = 0; (layer * step.layer + 1) * spacing <= 2 * half_height * (1 + kFitTolerance); ++layer) {
    const double height = (layer * step.layer + 0.5) * spacing - half_height;
    std::vector<Cell> in_layer;
    for (int row = -most_across; row <= most_across; ++row)
      for (int column = -most_along; column <= most_along; ++column) {
        const double x = column + (row % 2 ? step.row_shift : 0) + (layer % 2 ? step.layer_shift_along_row : 0);
        const double y = row * step.row + (layer % 2 ? step.layer_shift_across : 0);
        const Point cell = plus(plus(plus(centre, height, up), x * spacing, along), y * spacing, across);
        if (contains_ball(region, cell, spacing / 2)) in_layer.push_back({cell, std::lround((x * x + y * y) * 1e6)});
      }
    std::stable_sort(in_layer.begin(), in_layer.end(),
                     [](const Cell& a, const Cell& b) { return a.off_axis < b.off_axis; });
    for (const Cell& cell : in_layer) cells.push_back(cell.centre);
  }
  return cells;
}

std::vector<Placement> fill_region(const FillRegion& region, const std::vector<double>& bounding_radii,
                                   const FillLayout& layout, const Point& up, const std::string& place) {
  if (bounding_radii.empty()) return {};
  const double largest = *std::max_element(bounding_radii.begin(), bounding_radii.end());
  const double spacing = 2 * largest * (1 + layout.clearance);
  if (volume(region) / (spacing * spacing * spacing) > kMostCells)
    throw catalog::InputError(place + ": the largest body is " + millimetres(2 * largest) +
                              " across, far too small for this region; check the units of sizes and region");

  std::vector<Point> cells = lattice_cells(region, layout.lattice, spacing, up);
  if (cells.size() < bounding_radii.size())
    throw catalog::InputError(place + ": the region holds " + std::to_string(cells.size()) + " of the " +
                              std::to_string(bounding_radii.size()) + " bodies, in cells " + millimetres(spacing) +
                              " across (the largest body and the clearance); enlarge the region or lower the count");
  cells.resize(bounding_radii.size());

  RandomStream random(layout.seed);
  random.shuffle(cells);
  std::vector<Placement> placements;
  placements.reserve(cells.size());
  for (std::size_t body = 0; body < cells.size(); ++body) {
    const double room = layout.jitter * (spacing / 2 - bounding_radii[body]);
    placements.push_back({plus(cells[body], room, random.in_unit_ball<3>()), random.rotation()});
  }
  return placements;
}

}  // namespace workflows
