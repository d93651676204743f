// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/families/spherical_harmonics.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

/// Real harmonics at a direction: (degree + 1)^2 values, orthonormal over the sphere, by the recurrences of the
/// normalised Legendre functions (Holmes & Featherstone 2002, eqs. 11 and 13).
Eigen::VectorXd harmonics(const Point& direction, int degree) {
  Eigen::VectorXd values((degree + 1) * (degree + 1));
  const double cosine = std::clamp(direction[2], -1.0, 1.0), sine = std::sqrt(1 - cosine * cosine);
  const double azimuth = std::atan2(direction[1], direction[0]);
  double sectoral = std::sqrt(1 / (4 * std::numbers::pi));  // of degree m
  for (int m = 0; m <= degree; ++m) {
    if (m > 0) sectoral *= std::sqrt((2 * m + 1) / (2.0 * m)) * sine;
    const double both = m == 0 ? 1 : std::sqrt(2.0);
    const double along = both * std::cos(m * azimuth), across = both * std::sin(m * azimuth);
    double before = 0, now = sectoral;
    for (int n = m; n <= degree; ++n) {
      if (n > m) {
        const double nn = n * n, mm = m * m, last = (n - 1) * (n - 1);
        const double next =
            std::sqrt((4 * nn - 1) / (nn - mm)) * (cosine * now - std::sqrt((last - mm) / (4 * last - 1)) * before);
        before = now;
        now = next;
      }
      values[n * (n + 1) + m] = along * now;
      if (m > 0) values[n * (n + 1) - m] = across * now;
    }
  }
  return values;
}

/// Area of the unit sphere that the faces of each vertex take up, a third of each face.
std::vector<double> solid_angles(const catalog::TriangleMesh& mesh) {
  std::vector<double> angles(mesh.vertices.size());
  for (const catalog::Triangle& face : mesh.faces) {
    Point u[3];
    for (int c = 0; c < 3; ++c) u[c] = normalized(mesh.vertices[face[c]]);
    // Van Oosterom & Strackee 1983, eq. 8.
    const double angle =
        2 * std::atan2(dot(u[0], cross(u[1], u[2])), 1 + dot(u[0], u[1]) + dot(u[1], u[2]) + dot(u[2], u[0]));
    for (const int vertex : face) angles[vertex] += angle / 3;
  }
  return angles;
}

constexpr double kLongestEdge = 0.1;  // of a piece of a face over its distance: a quarter of a wave of degree 15

using Corners = std::array<Point, 3>;

/// Adds the integral of r Y over the solid angle of a flat triangle, in three points (degree 2), of its halves across
/// the longest edge where that is long.
void add_integral(const Corners& corners, int degree, Eigen::VectorXd& sum) {
  std::size_t longest = 0;  // edge from this corner to the next
  double length = 0, nearest = norm(corners[0]);
  for (std::size_t c = 0; c < 3; ++c) {
    const double edge = distance(corners[c], corners[(c + 1) % 3]);
    if (edge > length) {
      length = edge;
      longest = c;
    }
    nearest = std::min(nearest, norm(corners[c]));
  }
  if (length > kLongestEdge * nearest) {
    const Point &a = corners[longest], &b = corners[(longest + 1) % 3], &c = corners[(longest + 2) % 3];
    const Point middle = scaled(add(a, b), 0.5);
    add_integral({a, middle, c}, degree, sum);
    add_integral({middle, b, c}, degree, sum);
    return;
  }
  const Point area = scaled(cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0])), 0.5);
  for (std::size_t c = 0; c < 3; ++c) {
    const Point p = add(scaled(corners[c], 2.0 / 3), scaled(add(corners[(c + 1) % 3], corners[(c + 2) % 3]), 1.0 / 6));
    const double squared = dot(p, p);  // solid angle (p . area) / r^3, times r
    sum += dot(p, area) / (3 * squared) * harmonics(scaled(p, 1 / std::sqrt(squared)), degree);
  }
}

}  // namespace

std::vector<double> real_harmonics(const Point& direction, int degree) {
  const Eigen::VectorXd values = harmonics(direction, degree);
  return {values.begin(), values.end()};
}

std::vector<double> harmonic_amplitudes(const catalog::TriangleMesh& mesh, int degree) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero((degree + 1) * (degree + 1));
  for (const catalog::Triangle& face : mesh.faces)
    add_integral({mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]}, degree, sum);
  std::vector<double> amplitudes;
  for (int n = 0; n <= degree; ++n) amplitudes.push_back(sum.segment(n * n, 2 * n + 1).norm());
  return amplitudes;
}

catalog::TriangleMesh harmonic_low_pass(const catalog::TriangleMesh& mesh, int degree) {
  const std::vector<double> weights = solid_angles(mesh);
  const auto rows = static_cast<Eigen::Index>(mesh.vertices.size());
  Eigen::MatrixXd values(rows, (degree + 1) * (degree + 1));
  Eigen::VectorXd radii(rows), weight(rows);
  for (Eigen::Index v = 0; v < rows; ++v) {
    const Point& p = mesh.vertices[static_cast<std::size_t>(v)];
    values.row(v) = harmonics(normalized(p), degree);
    radii[v] = norm(p);
    weight[v] = weights[static_cast<std::size_t>(v)];
  }
  const Eigen::MatrixXd weighted = weight.asDiagonal() * values;
  const Eigen::VectorXd coefficients = (values.transpose() * weighted).ldlt().solve(weighted.transpose() * radii);
  const Eigen::VectorXd fitted = values * coefficients;
  catalog::TriangleMesh result = mesh;
  for (Eigen::Index v = 0; v < rows; ++v) {
    Point& p = result.vertices[static_cast<std::size_t>(v)];
    p = scaled(p, fitted[v] / radii[v]);
  }
  return result;
}

}  // namespace shape_pipeline
