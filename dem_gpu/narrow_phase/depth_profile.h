// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Triangle on which the depth is linear.
struct DepthTriangle {
  Vec3 a, b, c;                    // corners [m]
  Real depth_a, depth_b, depth_c;  // [m]
  Real area;                       // [m2]
};

/// Integrals over a triangle of a profile psi of the depth.
struct TriangleIntegrals {
  Real depth;         // integral of psi dA [m3]
  Vec3 depth_moment;  // integral of x psi dA [m4]
  Real area;          // integral of d psi / d depth dA [m2]
};

/// psi = depth.
struct LinearProfile {
  TALUS_HD TriangleIntegrals integrate(const DepthTriangle& t) const {
    const Real total = t.depth_a + t.depth_b + t.depth_c;
    return {t.area * total / 3,
            (t.area / 12) * (t.depth_a * t.a + t.depth_b * t.b + t.depth_c * t.c + total * (t.a + t.b + t.c)), t.area};
  }
};

/// psi = depth (1 + depth / hardening depth). Integrals of products of the corner weights w over a triangle:
/// w_a^i w_b^j w_c^k integrates to 2 area i! j! k! / (i + j + k + 2)!.
struct HardeningProfile {
  Real rate = 0;  // 1 / hardening depth [1/m]

  TALUS_HD TriangleIntegrals integrate(const DepthTriangle& t) const {
    TriangleIntegrals sum = LinearProfile{}.integrate(t);
    const Real p = t.depth_a, q = t.depth_b, r = t.depth_c;
    const Real squares = p * p + q * q + r * r, products = p * q + q * r + r * p, share = rate * t.area;
    sum.depth += share / 6 * (squares + products);
    const auto weight = [&](Real own, Real others) { return 2 * squares + 4 * own * own + 2 * products + 2 * own * others; };
    sum.depth_moment += (share / 60) * (weight(p, q + r) * t.a + weight(q, r + p) * t.b + weight(r, p + q) * t.c);
    sum.area += 2 * share / 3 * (p + q + r);
    return sum;
  }
};

}  // namespace dem_gpu
