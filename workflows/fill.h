// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace workflows {

using catalog::Point;

/// From `base` along the unit `axis` over `length`.
struct CylinderRegion {
  Point base{};       // [m]
  Point axis{};       // unit
  double radius = 0;  // [m]
  double length = 0;  // [m]
  friend bool operator==(const CylinderRegion&, const CylinderRegion&) = default;
};

struct BoxRegion {
  Point low{}, high{};  // opposite corners [m]
  friend bool operator==(const BoxRegion&, const BoxRegion&) = default;
};

using FillRegion = std::variant<CylinderRegion, BoxRegion>;

bool contains_ball(const FillRegion& region, const Point& centre, double radius);
double volume(const FillRegion& region);  // [m3]

enum class Lattice { hexagonal, cubic };

/// How bodies are set into a region.
struct FillLayout {
  Lattice lattice = Lattice::hexagonal;
  double clearance = 0.02;  // cell diameter over the largest bounding diameter, minus 1 [-]
  double jitter = 1;        // share of the free room in its cell over which a body is displaced, 0..1 [-]
  std::uint64_t seed = 1;
  friend bool operator==(const FillLayout&, const FillLayout&) = default;
};

struct Placement {
  Point position{};                               // of the bounding ball's centre [m]
  std::array<double, 4> orientation{1, 0, 0, 0};  // unit quaternion w, x, y, z
};

/// Centres of lattice cells, i.e. balls of diameter `spacing` that touch but do not overlap and lie inside the region:
/// layer on layer along the unit vector `up`, lowest first, each from its middle outwards.
std::vector<Point> lattice_cells(const FillRegion& region, Lattice lattice, double spacing, const Point& up);

/// One placement for each bounding radius: bodies in random cells of the lowest that are needed, displaced within their
/// cell, turned at random. Bounding balls neither overlap nor leave the region, since each stays in its cell's ball.
/// Throws catalog::InputError that starts with `place` if the region holds fewer, with how many and the remedy.
std::vector<Placement> fill_region(const FillRegion& region, const std::vector<double>& bounding_radii,
                                   const FillLayout& layout, const Point& up, const std::string& place);

}  // namespace workflows
