// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/solids/round_solids.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "shape_pipeline/solids/grid_surface.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double pi = std::numbers::pi;

/// A chord of angle pi / (2 detail) leaves a share of about angle^2 / 12 of each radius out; three for a volume.
double inscribed_loss(int detail) {
  const double angle = pi / (2 * detail);
  return angle * angle / 4;
}

/// Surface of the cube of half edge 1 with the same planes on each axis.
catalog::TriangleMesh cube_surface(const std::vector<double>& planes) {
  return grid_surface({planes, planes, planes}, [](int, int, int) { return true; });
}

/// x^p for p > 0 of a magnitude; the exponent may be large.
double power(double x, double p) { return x > 0 ? std::exp(p * std::log(x)) : 0; }

}  // namespace

BuiltSolid dice_solid(double rounding, int detail) {
  const double flat = 1 - rounding;
  std::vector<double> planes;
  // Equal angles as seen from the centre of the rounding.
  for (int k = 0; k <= detail; ++k) planes.push_back(flat + rounding * std::tan(pi / 4 * k / detail));
  std::vector<double> mirrored(planes.rbegin(), planes.rend());
  if (flat == 0) mirrored.pop_back();
  for (double& plane : mirrored) plane = -plane;
  mirrored.insert(mirrored.end(), planes.begin(), planes.end());

  BuiltSolid solid;
  solid.mesh = cube_surface(mirrored);
  for (Point& p : solid.mesh.vertices) {
    Point inner;
    for (int i = 0; i < 3; ++i) inner[i] = std::clamp(p[i], -flat, flat);
    p = add(inner, scaled(normalized(subtract(p, inner)), rounding));
  }
  // Steiner: the inner cube, slabs on its faces, quarter cylinders on its edges, a sphere at its corners.
  const double a = 2 * flat, r = rounding;
  solid.exact_volume = a * a * a + 6 * a * a * r + 3 * pi * a * r * r + 4 * pi / 3 * r * r * r;
  solid.volume_tolerance = inscribed_loss(detail);
  return solid;
}

BuiltSolid ring_solid(double tube, int detail) {
  const int turns = std::max(4 * detail, static_cast<int>(std::lround(4 * detail / std::sqrt(tube))));
  const int around = 4 * detail;
  BuiltSolid solid;
  for (int i = 0; i < turns; ++i)
    for (int j = 0; j < around; ++j) {
      const double u = 2 * pi * i / turns, v = 2 * pi * j / around, r = 1 + tube * std::cos(v);
      solid.mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
    }
  const auto at = [&](int i, int j) { return (i % turns) * around + j % around; };
  for (int i = 0; i < turns; ++i)
    for (int j = 0; j < around; ++j) {
      solid.mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      solid.mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  solid.genus = 1;
  solid.exact_volume = 2 * pi * pi * tube * tube;
  solid.volume_tolerance = 2 * inscribed_loss(detail);
  return solid;
}

BuiltSolid superquadric_solid(const Superquadric& form, int detail) {
  std::vector<double> planes;
  for (int k = -detail; k <= detail; ++k) planes.push_back(std::tan(pi / 4 * k / detail));
  BuiltSolid solid;
  solid.mesh = cube_surface(planes);
  const auto& [e1, e2, axes] = form;
  for (Point& p : solid.mesh.vertices) {
    // Along a ray from the centre the left side grows as radius^(2/e1).
    const double flat = power(std::abs(p[0]), 2 / e2) + power(std::abs(p[1]), 2 / e2);
    const double side = power(flat, e2 / e1) + power(std::abs(p[2]), 2 / e1);
    const double radius = power(side, -e1 / 2);
    for (int i = 0; i < 3; ++i) p[i] *= radius * axes[i];
  }
  const auto beta = [](double a, double b) { return std::exp(std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b)); };
  // Jaklic, Leonardis & Solina 2000, eq. 2.60.
  solid.exact_volume = 2 * axes[0] * axes[1] * axes[2] * e1 * e2 * beta(e1 / 2 + 1, e1) * beta(e2 / 2, e2 / 2);
  const double sharpest = std::max(1.0, 1 / std::min(e1, e2));  // its rim is the narrower by this
  solid.volume_tolerance = std::min(0.5, sharpest * 2 * inscribed_loss(detail));
  return solid;
}

}  // namespace shape_pipeline
