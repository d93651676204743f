// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Triangle on which the depth is linear, positions from wherever its moments are taken (MomentOrigin).
struct DepthTriangle {
  LocalVec3 a, b, c;                    // corners [m]
  LocalReal depth_a, depth_b, depth_c;  // [m]
  LocalReal area;                       // [m2]
};

/// Integrals over a triangle of a profile psi of the depth.
struct TriangleIntegrals {
  LocalReal depth;         // integral of psi dA [m3]
  LocalVec3 depth_moment;  // integral of x psi dA [m4]
  LocalReal area;          // integral of d psi / d depth dA [m2]
};

/// psi = depth.
struct LinearProfile {
  TALUS_HD Real value(Real depth) const { return depth; }
  TALUS_HD Real slope(Real /*depth*/) const { return 1; }
  TALUS_HD TriangleIntegrals integrate(const DepthTriangle& t) const {
    const LocalReal total = t.depth_a + t.depth_b + t.depth_c;
    return {t.area * total / 3,
            (t.area / 12) * (t.depth_a * t.a + t.depth_b * t.b + t.depth_c * t.c + total * (t.a + t.b + t.c)), t.area};
  }
  /// Integral of psi |x|^2 dA [m5].
  TALUS_HD LocalReal second_moment(const DepthTriangle& t) const {
    const LocalVec3 sum = t.a + t.b + t.c, weighted = t.depth_a * t.a + t.depth_b * t.b + t.depth_c * t.c;
    const LocalReal total = t.depth_a + t.depth_b + t.depth_c;
    const LocalReal aa = norm_squared(t.a), bb = norm_squared(t.b), cc = norm_squared(t.c);
    return (t.area / 60) * (total * (norm_squared(sum) + aa + bb + cc) + 2 * dot(weighted, sum) +
                            2 * (t.depth_a * aa + t.depth_b * bb + t.depth_c * cc));
  }
};

/// psi = depth (1 + depth / hardening depth). Integrals of products of the corner weights w over a triangle:
/// w_a^i w_b^j w_c^k integrates to 2 area i! j! k! / (i + j + k + 2)!.
struct HardeningProfile {
  LocalReal rate = 0;  // 1 / hardening depth [1/m]

  TALUS_HD Real value(Real depth) const { return depth * (1 + rate * depth); }
  TALUS_HD Real slope(Real depth) const { return 1 + 2 * rate * depth; }
  TALUS_HD TriangleIntegrals integrate(const DepthTriangle& t) const {
    TriangleIntegrals sum = LinearProfile{}.integrate(t);
    const LocalReal p = t.depth_a, q = t.depth_b, r = t.depth_c;
    const LocalReal squares = p * p + q * q + r * r, products = p * q + q * r + r * p, share = rate * t.area;
    sum.depth += share / 6 * (squares + products);
    const auto weight = [&](LocalReal own, LocalReal others) {
      return 2 * squares + 4 * own * own + 2 * products + 2 * own * others;
    };
    sum.depth_moment += (share / 60) * (weight(p, q + r) * t.a + weight(q, r + p) * t.b + weight(r, p + q) * t.c);
    sum.area += 2 * share / 3 * (p + q + r);
    return sum;
  }
  /// Integral of psi |x|^2 dA [m5], by the six-point rule that is exact to fourth order (Dunavant, Int. J. Numer.
  /// Methods Eng. 21 (1985) 1129-1148, p = 4).
  TALUS_HD LocalReal second_moment(const DepthTriangle& t) const {
    const auto at = [&](LocalReal u, LocalReal v, LocalReal w) {
      const LocalReal depth = u * t.depth_a + v * t.depth_b + w * t.depth_c;
      return depth * (1 + rate * depth) * norm_squared(u * t.a + v * t.b + w * t.c);
    };
    const auto orbit = [&](LocalReal u, LocalReal v) { return at(u, v, v) + at(v, u, v) + at(v, v, u); };
    return t.area * (LocalReal(0.223381589678011) * orbit(LocalReal(0.108103018168070), LocalReal(0.445948490915965)) +
                     LocalReal(0.109951743655322) * orbit(LocalReal(0.816847572980459), LocalReal(0.091576213509771)));
  }
};

}  // namespace dem_gpu
