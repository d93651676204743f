// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "catalog/convex_part.h"
#include "dem_gpu/overlap_probe.h"

/// Contact of two convex bodies under the depth potential, in double precision and as plainly as its definition: every
/// face clipped by every plane of the other body, then cut at every pair of its depths. The reference for the engine's
/// integrals in either precision.
namespace plain {

/// Depth of a body: the least depth below its faces, and `cap` [m]; psi = depth (1 + rate depth), rate [1/m].
struct Body {
  const catalog::ConvexPart& part;
  dem_gpu::BodyPose pose;
  double cap = 0;
  double rate = 0;
};

/// World axes, stiffness 1.
struct DepthForce {
  dem_gpu::Vec3 force;   // on a [m3]
  dem_gpu::Vec3 torque;  // on a about its position, without hardening [m4]
  double weight = 0;     // integral of psi dA over both surfaces [m3]
  double slope = 0;      // integral of d psi / d depth dA: how fast the force changes as a body moves [m2]
};

DepthForce depth_force(const Body& a, const Body& b);

}  // namespace plain
