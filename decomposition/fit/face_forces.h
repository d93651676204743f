// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "decomposition/geometry/random.h"
#include "decomposition/solid/solid.h"

namespace decomposition {

/// What pushes the vertices of a polyhedron towards the least symmetric difference, for one step of a fit.
struct VertexForces {
  std::vector<Vec3> force;    // minus the derivative of the difference with respect to the vertex [m2]
  std::vector<double> share;  // area that moves with the vertex: a third of its faces [m2]
};

/// How to sample the faces.
struct ForceSampling {
  int along = 4;           // at most this squared points a face, stratified and shifted anew on each face
  double rock_weight = 1;  // of rock left out against void taken in
  bool interpolates =
      true;             // between cells; thin bodies need it, comparing cuts does not and takes one look-up of eight
  double steering = 0;  // added to the pull everywhere: positive pushes inward
};

/// Derivative of the symmetric difference with respect to a vertex: over its faces, the integral of (barycentric
/// weight) x (1 - 2 occupancy) x normal. Faces for which `is_skipped` holds do not count.
template <class IsSkipped>
void gather_forces(const Solid& solid, const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& faces,
                   const ForceSampling& sampling, Random& random, const IsSkipped& is_skipped, VertexForces& forces) {
  forces.force.assign(points.size(), {});
  forces.share.assign(points.size(), 0.0);
  for (const auto& face : faces) {
    if (is_skipped(face)) continue;
    const Vec3 &a = points[static_cast<std::size_t>(face[0])], &b = points[static_cast<std::size_t>(face[1])],
               &c = points[static_cast<std::size_t>(face[2])];
    const Vec3 area_normal = 0.5 * cross(b - a, c - a);
    const double area = norm(area_normal);
    const int n = std::clamp(static_cast<int>(std::sqrt(area) / (0.8 * solid.cell())) + 1, std::min(2, sampling.along),
                             sampling.along);
    const double shift_u = random.uniform(), shift_v = random.uniform();
    const Vec3 ga = solid.to_field(a), gb = solid.to_field(b), gc = solid.to_field(c);
    const bool is_in_field = solid.is_in_field(ga) && solid.is_in_field(gb) && solid.is_in_field(gc);
    const Vec3 along_u = gb - ga, along_v = gc - ga;
    const double pitch = 1.0 / n;
    double filled_sum = 0, filled_u = 0, filled_v = 0, sum_u = 0, sum_v = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        double u = (i + shift_u) * pitch, v = (j + shift_v) * pitch;
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Vec3 g = ga + u * along_u + v * along_v;
        const double filled =
            is_in_field || solid.is_in_field(g) ? (sampling.interpolates ? solid.field_at(g) : solid.filled_at(g)) : 0;
        filled_sum += filled;
        filled_u += u * filled;
        filled_v += v * filled;
        sum_u += u;
        sum_v += v;
      }
    // The pull is 1 - (1 + rock_weight) filled + steering.
    const double gain = 1 + sampling.rock_weight, base = 1 + sampling.steering;
    const double whole = base * n * n - gain * filled_sum, part_u = base * sum_u - gain * filled_u,
                 part_v = base * sum_v - gain * filled_v;
    const double weight[3] = {whole - part_u - part_v, part_u, part_v};
    for (int k = 0; k < 3; ++k) {
      const auto vertex = static_cast<std::size_t>(face[static_cast<std::size_t>(k)]);
      forces.force[vertex] -= (weight[k] * pitch * pitch) * area_normal;
      forces.share[vertex] += area / 3;
    }
  }
}

}  // namespace decomposition
