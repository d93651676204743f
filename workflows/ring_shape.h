// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/scene.h"

namespace workflows {

/// A ring of round wire, as a chain link or a grain of its own.
struct RingShape {
  double diameter = 1;  // of the wire's centreline [m]
  double wire = 0;      // the wire's diameter [m]
  int segments = 12;    // straight convex parts that the ring is cut into
  int sides = 8;        // of the wire's cross-section
};

/// The ring as a partition: prisms between radial planes, the wire's corners on its circle, so that the body lies
/// within the true ring and meets it at the corners. Throws catalog::InputError if the wire is too thick to leave a
/// hole.
dem_gpu::Shape ring_shape(const std::string& name, const RingShape& ring);

}  // namespace workflows
