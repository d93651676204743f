// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

struct InscribedSphere {
  catalog::Point centre{};
  double radius = 0;  // [m]
};

/// The largest sphere inside a closed, outward mesh: climbed to from the middles of chords, by steps that each solve a
/// linear program of the distances to the faces near it. A local largest one, to rounding where flat faces hold it;
/// that it is the largest of all is never proven.
InscribedSphere inscribed_sphere(const catalog::TriangleMesh& mesh);

/// Point of the triangle nearest to p (Ericson 2005, section 5.1.5).
catalog::Point nearest_in_triangle(const catalog::Point& p, const catalog::Point& a, const catalog::Point& b,
                                   const catalog::Point& c);

}  // namespace shape_pipeline
