// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "catalog/convex_part.h"
#include "catalog/mass_properties.h"
#include "tests/support/sample_shapes.h"

namespace {

using namespace catalog;
using namespace test_support;

// Rounding of sums over some tens of faces, relative.
constexpr double kRounding = 1e-13;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Every face of the hull of points in convex position: triangles with no point outside, coplanar ones as a fan about
/// their centre, which becomes a vertex. Brute force, for a few points.
TriangleMesh hull_of(const std::vector<Point>& points) {
  TriangleMesh mesh{points, {}};
  std::vector<std::vector<int>> done;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k) {
        Point normal = cross(minus(points[j], points[i]), minus(points[k], points[i]));
        std::vector<int> on_plane;
        int above = 0, below = 0;
        for (int p = 0; p < n; ++p) {
          const double height = dot(normal, minus(points[p], points[i]));
          if (std::abs(height) < 1e-9)
            on_plane.push_back(p);
          else
            ++(height > 0 ? above : below);
        }
        if ((above > 0 && below > 0) || std::find(done.begin(), done.end(), on_plane) != done.end()) continue;
        done.push_back(on_plane);
        if (above > 0) normal = {-normal[0], -normal[1], -normal[2]};
        Point centre{};
        for (const int p : on_plane)
          for (int c = 0; c < 3; ++c) centre[c] += points[p][c] / static_cast<double>(on_plane.size());
        const Point first = minus(points[on_plane[0]], centre), second = cross(normal, first);
        std::sort(on_plane.begin(), on_plane.end(), [&](int a, int b) {
          const auto turn = [&](int p) {
            const Point from = minus(points[p], centre);
            return std::atan2(dot(from, second) / std::sqrt(dot(normal, normal)), dot(from, first));
          };
          return turn(a) < turn(b);
        });
        mesh.vertices.push_back(centre);
        const int hub = static_cast<int>(mesh.vertices.size()) - 1;
        for (std::size_t e = 0; e < on_plane.size(); ++e)
          mesh.faces.push_back({hub, on_plane[e], on_plane[(e + 1) % on_plane.size()]});
      }
  return mesh;
}

struct Platonic {
  const char* name;
  std::vector<Point> vertices;
  double edge;
  double volume;   // for edge 1
  double inertia;  // moment about any axis through the centre / (mass edge^2)
};

/// Closed forms for edge 1; the moments of the solids of mass 1 follow from the second moment of a regular polytope.
std::vector<Platonic> platonic_solids() {
  const double root5 = std::sqrt(5.0), golden = std::numbers::phi, inverse = 1 / golden;
  std::vector<Platonic> solids{
      {"tetrahedron",
       {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
       std::sqrt(8.0),
       std::sqrt(2.0) / 12,
       1.0 / 20},
      {"octahedron",
       {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
       std::sqrt(2.0),
       std::sqrt(2.0) / 3,
       1.0 / 10},
      {"cube", box_mesh({-1, -1, -1}, {1, 1, 1}).vertices, 2, 1, 1.0 / 6},
      {"icosahedron", {}, 2, 5 * (3 + root5) / 12, (3 + root5) / 20},
      {"dodecahedron", box_mesh({-1, -1, -1}, {1, 1, 1}).vertices, 2 * inverse, (15 + 7 * root5) / 4,
       (95 + 39 * root5) / 300},
  };
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      for (const Point& p : {Point{0, a, b * golden}, Point{a, b * golden, 0}, Point{b * golden, 0, a}})
        solids[3].vertices.push_back(p);
      for (const Point& p :
           {Point{0, a * inverse, b * golden}, Point{a * inverse, b * golden, 0}, Point{b * golden, 0, a * inverse}})
        solids[4].vertices.push_back(p);
    }
  return solids;
}

TEST(MassProperties, PlatonicSolids) {
  for (const Platonic& solid : platonic_solids()) {
    SCOPED_TRACE(solid.name);
    const MassProperties found = mass_properties(hull_of(solid.vertices));
    const double volume = solid.volume * std::pow(solid.edge, 3);
    EXPECT_NEAR(found.volume, volume, kRounding * volume);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.centroid[i], 0, kRounding * solid.edge);
      const double inertia = solid.inertia * volume * solid.edge * solid.edge;
      EXPECT_NEAR(found.principal_inertia[i], inertia, kRounding * inertia);
    }
  }
}

Matrix3 random_rotation(std::mt19937_64& random) {
  // A unit quaternion from four normal deviates is uniform over rotations.
  std::normal_distribution<double> normal;
  std::array<double, 4> q;
  double length = 0;
  for (double& component : q) {
    component = normal(random);
    length += component * component;
  }
  for (double& component : q) component /= std::sqrt(length);
  const auto [w, x, y, z] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

void move(TriangleMesh& mesh, const Matrix3& rotation, const Point& shift) {
  for (Point& vertex : mesh.vertices) {
    const Point old = vertex;
    for (int i = 0; i < 3; ++i) vertex[i] = dot(rotation[i], old) + shift[i];
  }
}

// I = V (b^2 + c^2) / 12 for a box of sides a, b, c. Rounding grows with the square of distance over size.
TEST(MassProperties, BoxesAnywhereAndTurned) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> side(0.5, 3);
  for (const double distance : {0.0, 1.0, 100.0, 1e4}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const double a = side(random) + 6, b = side(random) + 3, c = side(random);  // ascending inertia about x, y, z
      TriangleMesh mesh = box_mesh({-a / 2, -b / 2, -c / 2}, {a / 2, b / 2, c / 2});
      const Matrix3 rotation = random_rotation(random);
      const Point shift{distance, -2 * distance, 0.5 * distance};
      move(mesh, rotation, shift);
      const MassProperties found = mass_properties(mesh);
      const double tolerance = 1e-12 + 2e-15 * distance * distance;
      EXPECT_NEAR(found.volume, a * b * c, tolerance * a * b * c);
      const double expected[] = {b * b + c * c, a * a + c * c, a * a + b * b};
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found.centroid[i], shift[i], 1e-13 * (1 + 10 * distance));
        EXPECT_NEAR(found.principal_inertia[i], a * b * c * expected[i] / 12, 10 * tolerance * a * b * c * expected[i]);
        // Row i of the axes is the box's own axis i in the world, up to its sign.
        const Point axis{rotation[0][i], rotation[1][i], rotation[2][i]};
        EXPECT_NEAR(std::abs(dot(found.principal_axes[i], axis)), 1, 100 * tolerance);
      }
    }
  }
}

TEST(MassProperties, MicrometreGrainKeepsItsDigits) {
  const double s = 1e-6;
  const MassProperties found = mass_properties(box_mesh({0, 0, 0}, {3 * s, 2 * s, s}));
  const double volume = 6 * s * s * s;
  EXPECT_NEAR(found.volume, volume, kRounding * volume);
  EXPECT_NEAR(found.centroid[0], 1.5 * s, kRounding * s);
  EXPECT_NEAR(found.principal_inertia[0], volume * 5 * s * s / 12, 1e-12 * volume * s * s);
  EXPECT_NEAR(found.principal_inertia[2], volume * 13 * s * s / 12, 1e-12 * volume * s * s);
}

TEST(MassProperties, MomentsOfAPartitionAddUp) {
  VolumeMoments sum = volume_moments(box_mesh({-1, -1, -1}, {0.3, 2, 1}));
  sum += volume_moments(triangulated(box_part({0.3, -1, -1}, {2, 2, 1})));
  const MassProperties whole = mass_properties(box_mesh({-1, -1, -1}, {2, 2, 1})), joined = mass_properties(sum);
  EXPECT_NEAR(joined.volume, whole.volume, kRounding * whole.volume);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(joined.centroid[i], whole.centroid[i], kRounding);
    EXPECT_NEAR(joined.principal_inertia[i], whole.principal_inertia[i], 1e-12 * whole.principal_inertia[i]);
  }
}

TEST(MassProperties, InwardNormalsGiveNegativeVolumeAndNothingGivesZero) {
  TriangleMesh inside_out = box_mesh({0, 0, 0}, {1, 1, 1});
  for (Triangle& face : inside_out.faces) std::swap(face[0], face[1]);
  EXPECT_NEAR(volume_moments(inside_out).volume, -1, kRounding);
  EXPECT_EQ(mass_properties(TriangleMesh{}).volume, 0);
}

// A = R^T diag R: the values come back ascending, the axes satisfy A v = lambda v, are orthonormal and right-handed.
TEST(SymmetricEigen, RandomMatrices) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> value(-5, 5);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const Matrix3 rotation = random_rotation(random);
    std::array<double, 3> expected{value(random), value(random), value(random)};
    if (repeat % 3 == 0) expected[1] = expected[0];
    Matrix3 matrix{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) matrix[i][j] += rotation[k][i] * expected[k] * rotation[k][j];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < i; ++j) matrix[i][j] = matrix[j][i];
    Point values;
    Matrix3 axes;
    symmetric_eigen(matrix, values, axes);
    std::sort(expected.begin(), expected.end());
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(values[i], expected[i], 1e-13);
      for (int r = 0; r < 3; ++r) EXPECT_NEAR(dot(matrix[r], axes[i]), values[i] * axes[i][r], 1e-13);
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(dot(axes[i], axes[j]), i == j, 1e-14);
    }
    EXPECT_NEAR(dot(cross(axes[0], axes[1]), axes[2]), 1, 1e-14);
  }
}

TEST(SymmetricEigen, DiagonalAndSignsAreFixed) {
  Point values;
  Matrix3 axes;
  symmetric_eigen({{{3, 0, 0}, {0, 1, 0}, {0, 0, 2}}}, values, axes);
  EXPECT_EQ(values, (Point{1, 2, 3}));
  EXPECT_EQ(axes[0], (Point{0, 1, 0}));
  EXPECT_EQ(axes[1], (Point{0, 0, 1}));
  EXPECT_EQ(axes[2], (Point{1, 0, 0}));
  symmetric_eigen({}, values, axes);
  EXPECT_EQ(values, (Point{0, 0, 0}));
}

TEST(ConvexPart, TriangulatedFansKeepVolumeAndOrientation) {
  EXPECT_NEAR(volume_moments(triangulated(box_part({0, 0, 0}, {1, 2, 3}))).volume, 6, kRounding);
  EXPECT_EQ(triangulated(box_part({0, 0, 0}, {1, 2, 3})).face_count(), 12u);
}

}  // namespace
