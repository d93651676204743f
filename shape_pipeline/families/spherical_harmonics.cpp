// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/families/spherical_harmonics.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

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

}  // namespace

std::vector<double> real_harmonics(const Point& direction, int degree) {
  std::vector<double> values(static_cast<std::size_t>((degree + 1) * (degree + 1)));
  const double polar = std::acos(std::clamp(direction[2], -1.0, 1.0)), azimuth = std::atan2(direction[1], direction[0]);
  for (int n = 0; n <= degree; ++n)
    for (int m = 0; m <= n; ++m) {
      const double legendre = std::sph_legendre(static_cast<unsigned>(n), static_cast<unsigned>(m), polar);
      const double both = m == 0 ? 1 : std::sqrt(2.0);
      values[static_cast<std::size_t>(n * (n + 1) + m)] = both * legendre * std::cos(m * azimuth);
      if (m > 0) values[static_cast<std::size_t>(n * (n + 1) - m)] = both * legendre * std::sin(m * azimuth);
    }
  return values;
}

catalog::TriangleMesh harmonic_low_pass(const catalog::TriangleMesh& mesh, int degree) {
  const std::vector<double> weights = solid_angles(mesh);
  const auto rows = static_cast<Eigen::Index>(mesh.vertices.size());
  Eigen::MatrixXd values(rows, (degree + 1) * (degree + 1));
  Eigen::VectorXd radii(rows), weight(rows);
  for (Eigen::Index v = 0; v < rows; ++v) {
    const Point& p = mesh.vertices[static_cast<std::size_t>(v)];
    const std::vector<double> at_vertex = real_harmonics(normalized(p), degree);
    values.row(v) = Eigen::Map<const Eigen::RowVectorXd>(at_vertex.data(), values.cols());
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
