// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/lane_vec3.h"

namespace dem_gpu {

/// Triangle on which the depth is linear, positions from wherever its moments are taken (MomentOrigin). Of numbers, or
/// of lanes of them: eight triangles at a time.
template <class Number, class Vector>
struct BasicDepthTriangle {
  Vector a, b, c;                    // corners [m]
  Number depth_a, depth_b, depth_c;  // [m]
  Number area;                       // [m2]
};
using DepthTriangle = BasicDepthTriangle<LocalReal, LocalVec3>;
using DepthTriangles = BasicDepthTriangle<Lanes, LaneVec3>;

/// Integrals over a triangle of a profile psi of the depth.
template <class Number, class Vector>
struct BasicTriangleIntegrals {
  Number depth;         // integral of psi dA [m3]
  Vector depth_moment;  // integral of x psi dA [m4]
  Number area;          // integral of d psi / d depth dA [m2]
};
using TriangleIntegrals = BasicTriangleIntegrals<LocalReal, LocalVec3>;

/// psi = depth.
struct LinearProfile {
  TALUS_HD Real value(Real depth) const { return depth; }
  TALUS_HD Real slope(Real /*depth*/) const { return 1; }
  template <class Number, class Vector>
  TALUS_HD BasicTriangleIntegrals<Number, Vector> integrate(const BasicDepthTriangle<Number, Vector>& t) const {
    const Number total = t.depth_a + t.depth_b + t.depth_c, twelfth = (LocalReal(1) / 12) * t.area;
    return {4 * (twelfth * total),
            twelfth * (t.depth_a * t.a + t.depth_b * t.b + t.depth_c * t.c + total * (t.a + t.b + t.c)), t.area};
  }
  /// Integral of psi |x|^2 dA [m5].
  template <class Number, class Vector>
  TALUS_HD Number second_moment(const BasicDepthTriangle<Number, Vector>& t) const {
    const Vector sum = t.a + t.b + t.c, weighted = t.depth_a * t.a + t.depth_b * t.b + t.depth_c * t.c;
    const Number total = t.depth_a + t.depth_b + t.depth_c;
    const Number aa = norm_squared(t.a), bb = norm_squared(t.b), cc = norm_squared(t.c);
    return (LocalReal(1) / 60) * t.area *
           (total * (norm_squared(sum) + aa + bb + cc) +
            2 * (dot(weighted, sum) + t.depth_a * aa + t.depth_b * bb + t.depth_c * cc));
  }
};

/// psi = depth (1 + depth / hardening depth). Integrals of products of the corner weights w over a triangle:
/// w_a^i w_b^j w_c^k integrates to 2 area i! j! k! / (i + j + k + 2)!.
struct HardeningProfile {
  LocalReal rate = 0;  // 1 / hardening depth [1/m]

  TALUS_HD Real value(Real depth) const { return depth * (1 + rate * depth); }
  TALUS_HD Real slope(Real depth) const { return 1 + 2 * rate * depth; }
  template <class Number, class Vector>
  TALUS_HD BasicTriangleIntegrals<Number, Vector> integrate(const BasicDepthTriangle<Number, Vector>& t) const {
    BasicTriangleIntegrals<Number, Vector> sum = LinearProfile{}.integrate(t);
    const Number p = t.depth_a, q = t.depth_b, r = t.depth_c;
    const Number squares = p * p + q * q + r * r, products = p * q + q * r + r * p;
    const Number sixth = (rate / 6) * t.area;
    sum.depth = sum.depth + sixth * (squares + products);
    const auto weight = [&](const Number& own, const Number& others) {
      return 2 * (squares + 2 * own * own + products + own * others);
    };
    sum.depth_moment +=
        (LocalReal(0.1) * sixth) * (weight(p, q + r) * t.a + weight(q, r + p) * t.b + weight(r, p + q) * t.c);
    sum.area = sum.area + 4 * (sixth * (p + q + r));
    return sum;
  }
  /// Integral of psi |x|^2 dA [m5], by the six-point rule that is exact to fourth order (Dunavant, Int. J. Numer.
  /// Methods Eng. 21 (1985) 1129-1148, p = 4).
  template <class Number, class Vector>
  TALUS_HD Number second_moment(const BasicDepthTriangle<Number, Vector>& t) const {
    const auto orbit = [&](LocalReal u, LocalReal v) { return at(t, u, v, v) + at(t, v, u, v) + at(t, v, v, u); };
    return t.area * (LocalReal(0.223381589678011) * orbit(LocalReal(0.108103018168070), LocalReal(0.445948490915965)) +
                     LocalReal(0.109951743655322) * orbit(LocalReal(0.816847572980459), LocalReal(0.091576213509771)));
  }

 private:
  /// psi |x|^2 where the corners have these weights [m3].
  template <class Number, class Vector>
  TALUS_HD Number at(const BasicDepthTriangle<Number, Vector>& t, LocalReal u, LocalReal v, LocalReal w) const {
    const Number depth = u * t.depth_a + v * t.depth_b + w * t.depth_c;
    return (depth + rate * depth * depth) * norm_squared(u * t.a + v * t.b + w * t.c);
  }
};

}  // namespace dem_gpu
