// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "dem_gpu/scene.h"

namespace workflows {

/// How the links of a chain lie at time 0.
struct ChainLayout {
  int links = 2;
  dem_gpu::Vec3 start;                // centre of the first link [m]
  dem_gpu::Vec3 direction{0, 0, -1};  // of an open chain; for a closed one the axis of the circle it lies on; unit
  double gap = 0.1;                   // between neighbouring wires at the start, share of the wire's thickness [-]
  bool is_closed = false;             // last link in first
  bool holds_first = false;           // the first link is fixed
};

/// A link's hole, in the body frame.
struct LinkHole {
  dem_gpu::Vec3 normal;     // the axis through the hole, unit
  dem_gpu::Vec3 length;     // in the link's plane, along the chain, unit
  double inner_ahead = 0;   // from the centre to the wire along `length` [m]
  double inner_behind = 0;  // and against it
  double outer_ahead = 0;   // from the centre to the far side of the wire [m]
  double outer_behind = 0;
};

/// Throws catalog::InputError (beginning with `place`) if no principal axis of the shape passes through a hole.
LinkHole link_hole(const dem_gpu::Shape& shape, const std::string& place);

/// Links in a row (or on a circle), each turned by a quarter about the chain against the last, so that each goes
/// through the next without touching. Shape index, material and velocity are the caller's. Throws catalog::InputError
/// (beginning with `place`) if the hole is too small for two wires, or links would overlap.
std::vector<dem_gpu::Body> chain_bodies(const dem_gpu::Shape& link, const ChainLayout& layout,
                                        const std::string& place);

}  // namespace workflows
