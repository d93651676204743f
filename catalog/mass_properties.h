// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "catalog/triangle_mesh.h"

namespace catalog {

using Matrix3 = std::array<std::array<double, 3>, 3>;  // [row][column]

/// Rigid-body properties of a solid of density 1 kg/m3.
struct MassProperties {
  double volume = 0;                                          // [m3]
  Point centroid{};                                           // [m]
  Point principal_inertia{};                                  // about the centroid, ascending [m5]
  Matrix3 principal_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // row i: unit axis of principal_inertia[i]; right-handed
};

/// Volume integrals of a solid: additive over parts, so that a partition's union follows exactly.
struct VolumeMoments {
  double volume = 0;  // integral of 1 [m3]
  Point first{};      // integral of x [m4]
  Matrix3 second{};   // integral of x x^T [m5]

  VolumeMoments& operator+=(const VolumeMoments& other) {
    volume += other.volume;
    for (int i = 0; i < 3; ++i) {
      first[i] += other.first[i];
      for (int j = 0; j < 3; ++j) second[i][j] += other.second[i][j];
    }
    return *this;
  }
};

/// Moments of the solid bounded by a closed mesh with outward normals, by signed tetrahedra to `reference`
/// (choose it near the solid, to avoid cancellation). Positive volume for outward normals.
inline VolumeMoments volume_moments(const TriangleMesh& mesh) {
  VolumeMoments moments;
  if (mesh.vertices.empty()) return moments;
  const Point reference = mesh.vertices.front();
  for (const Triangle& face : mesh.faces) {
    Point corner[3];
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i) corner[c][i] = mesh.vertices[face[c]][i] - reference[i];
    const auto& [a, b, c] = corner;
    const double six_volumes =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    moments.volume += six_volumes / 6;
    for (int i = 0; i < 3; ++i) {
      moments.first[i] += six_volumes / 24 * (a[i] + b[i] + c[i]);
      for (int j = 0; j < 3; ++j)
        moments.second[i][j] +=
            six_volumes / 120 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + (a[i] + b[i] + c[i]) * (a[j] + b[j] + c[j]));
    }
  }
  // Shift back from the reference point to the mesh's own origin.
  const Point f = moments.first;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      moments.second[i][j] += reference[i] * f[j] + f[i] * reference[j] + moments.volume * reference[i] * reference[j];
  for (int i = 0; i < 3; ++i) moments.first[i] += moments.volume * reference[i];
  return moments;
}

/// Eigenvalues (ascending) and unit eigenvectors (rows, right-handed) of a symmetric matrix by cyclic Jacobi rotations
/// (Golub & Van Loan 2013, section 8.5). The sign of each axis is fixed: its largest component is positive.
inline void symmetric_eigen(Matrix3 matrix, Point& values, Matrix3& axes) {
  Matrix3 vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // columns
  const double scale = std::abs(matrix[0][0]) + std::abs(matrix[1][1]) + std::abs(matrix[2][2]);
  for (int sweep = 0; sweep < 50; ++sweep) {
    const double off_diagonal = std::max({std::abs(matrix[0][1]), std::abs(matrix[0][2]), std::abs(matrix[1][2])});
    if (off_diagonal <= 1e-14 * scale) break;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        // Of equal moments any axes are principal: rounding must not turn those given.
        if (std::abs(matrix[p][q]) <= 1e-14 * scale) continue;
        const double theta = (matrix[q][q] - matrix[p][p]) / (2 * matrix[p][q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double kp = matrix[k][p], kq = matrix[k][q];
          matrix[k][p] = c * kp - s * kq;
          matrix[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 3; ++k) {
          const double pk = matrix[p][k], qk = matrix[q][k];
          matrix[p][k] = c * pk - s * qk;
          matrix[q][k] = s * pk + c * qk;
          const double vp = vectors[k][p], vq = vectors[k][q];
          vectors[k][p] = c * vp - s * vq;
          vectors[k][q] = s * vp + c * vq;
        }
      }
  }
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return matrix[i][i] < matrix[j][j]; });
  for (int i = 0; i < 3; ++i) {
    values[i] = matrix[order[i]][order[i]];
    for (int k = 0; k < 3; ++k) axes[i][k] = vectors[k][order[i]];
  }
  for (int i = 0; i < 2; ++i) {
    int largest = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(axes[i][k]) > std::abs(axes[i][largest]) * (1 + 1e-9)) largest = k;
    if (axes[i][largest] < 0)
      for (double& component : axes[i]) component = -component;
  }
  axes[2] = {axes[0][1] * axes[1][2] - axes[0][2] * axes[1][1], axes[0][2] * axes[1][0] - axes[0][0] * axes[1][2],
             axes[0][0] * axes[1][1] - axes[0][1] * axes[1][0]};
}

/// Inertia tensor of a solid of density 1 about its centre of mass, axes of the moments' frame [m5].
inline Matrix3 inertia_tensor(const VolumeMoments& moments) {
  Point centroid;
  for (int i = 0; i < 3; ++i) centroid[i] = moments.first[i] / moments.volume;
  Matrix3 central = moments.second;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) central[i][j] -= moments.volume * centroid[i] * centroid[j];
  const double trace = central[0][0] + central[1][1] + central[2][2];
  Matrix3 inertia;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inertia[i][j] = (i == j ? trace : 0) - central[i][j];
  return inertia;
}

/// Centroid, principal inertia and principal axes of a solid of density 1 from its moments.
inline MassProperties mass_properties(const VolumeMoments& moments) {
  MassProperties result;
  result.volume = moments.volume;
  if (moments.volume == 0) return result;
  for (int i = 0; i < 3; ++i) result.centroid[i] = moments.first[i] / moments.volume;
  symmetric_eigen(inertia_tensor(moments), result.principal_inertia, result.principal_axes);
  return result;
}

inline MassProperties mass_properties(const TriangleMesh& mesh) { return mass_properties(volume_moments(mesh)); }

}  // namespace catalog
