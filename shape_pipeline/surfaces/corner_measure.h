// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// How sharp the corners and ridges of a solid are, at one scale.
///
/// A point x of the surface sees the share f(x) of a Gaussian ball of standard deviation `scale` inside the solid (an
/// integral invariant: Pottmann et al. 2007). It is 1/2 on a plane, angle / 2 pi on an edge, and on a sphere of radius
/// r it is erf(sqrt(2) r/s) / 2 - (1 - exp(-2 r^2/s^2)) s / (sqrt(2 pi) r): that gives each point an equivalent radius
/// r(x). Corners are where r is below the radius R of the largest inscribed sphere (Wadell 1932; in three dimensions
/// Zheng, He & Alimohammadi 2020).
struct CornerMeasure {
  double scale = 0;       // standard deviation of the Gaussian ball [m]
  double area_share = 0;  // of the corners [-]
  double roundness = 1;   // mean of r / R over the corners by area; 1 without corners [-]
  double angularity = 0;  // mean of max(0, 1 - r / R) over the whole surface by area [-]
};

/// Of a closed, outward mesh, with scale = kCornerScale * inscribed_radius. Its faces are cut and merged to a quarter
/// of the scale, so that the mesh hardly matters where its edges are below the scale. None where the solid is so thin
/// that its surface would need more than kMostCornerCells pieces of that size.
std::optional<CornerMeasure> corner_measure(const catalog::TriangleMesh& mesh, double inscribed_radius);

inline constexpr double kCornerScale = 0.2;  // of the Gaussian ball over the inscribed radius: below a noisy scanner's
                                             // waves nothing is seen, above it ridges melt into one another
inline constexpr double kMostCornerCells = 400000;  // two CPU seconds

/// f on a sphere; radius and scale in one unit.
double inside_share_on_sphere(double radius, double scale);

/// f at a point of a solid: for a closed, outward mesh whose edges are well below the scale.
double inside_share(const catalog::TriangleMesh& mesh, const catalog::Point& x, double scale);

}  // namespace shape_pipeline
