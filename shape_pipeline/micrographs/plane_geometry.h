// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "shape_pipeline/outline_descriptors.h"

namespace shape_pipeline {

/// Area, centroid and central second moments of the region inside a simple polygon, by exact sums over its edges.
struct PlaneMoments {
  double area = 0;  // positive if the corners turn from x towards y
  PlanePoint centroid{};
  double xx = 0, xy = 0, yy = 0;  // of the area, about the centroid, over the area
};
PlaneMoments plane_moments(const Outline& outline);

/// The ellipse of the region's area and ratio of second moments (ImageJ's fitted ellipse).
struct FittedEllipse {
  double major = 0, minor = 0;  // full axes
  double angle = 0;             // of the major axis to x, towards y [rad]
};
FittedEllipse fitted_ellipse(const PlaneMoments& moments);

double perimeter(const Outline& outline);

/// The outline with a positive area.
Outline with_positive_area(Outline outline);

/// Corners of the convex hull, of positive area, none on an edge (Andrew 1979).
Outline plane_hull(const Outline& points);

/// Distances of parallel lines about a convex outline.
struct Calipers {
  double feret_max = 0, feret_max_angle = 0;  // largest distance of two corners; its angle to x, towards y [rad]
  double feret_min = 0;                       // least distance
  double across_max = 0;                      // square to feret_max
  double box_area = 0;                        // of the rectangle of least area
};
Calipers calipers(const Outline& hull);

/// Radius of the largest circle inside a simple polygon: by halving squares down to the tolerance (in the outline's
/// unit), then climbing from the best of them. The time grows with the outline's length over the tolerance.
double inscribed_circle_radius(const Outline& outline, double tolerance);

/// Distance of a point to the polygon's edges, negative outside.
double depth_inside(const Outline& outline, const PlanePoint& point);

/// Pockets between an outline and its hull, as polygons.
std::vector<Outline> hull_pockets(const Outline& outline);

}  // namespace shape_pipeline
