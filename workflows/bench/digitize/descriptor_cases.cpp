// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "shape_pipeline/built_in_solids.h"
#include "shape_pipeline/shape_descriptors.h"
#include "workflows/bench/digitize/digitize_cases.h"

namespace workflows {
namespace {

namespace sp = shape_pipeline;
using Descriptors = std::map<std::string, double>;

constexpr double kPi = std::numbers::pi, kGoal = 1e-6;

double wadell(double volume, double area) { return std::cbrt(kPi) * std::pow(6 * volume, 2.0 / 3) / area; }

/// Of a regular polyhedron of edge 1 whose faces touch its inscribed sphere.
Descriptors regular(double volume, double area, double enclosing) {
  const double inscribed = 3 * volume / area;
  return {{"volume", volume},
          {"surface_area", area},
          {"volume_hull", volume},
          {"convexity_volume_ratio", 1},
          {"sphericity_wadell", wadell(volume, area)},
          {"radius_inscribed", inscribed},
          {"radius_enclosing", enclosing},
          {"sphericity_inscribed_enclosing", inscribed / enclosing},
          {"compactness_bagi_orosz", 1},
          {"equivalent_diameter_volume", std::cbrt(6 * volume / kPi)}};
}

/// The same, opposite to itself: faces and vertices lie in pairs.
Descriptors symmetric(double volume, double area, double enclosing) {
  Descriptors exact = regular(volume, area, enclosing);
  exact["feret_min"] = 2 * exact.at("radius_inscribed");
  exact["feret_max"] = 2 * enclosing;
  return exact;
}

Descriptors tetrahedron() {
  Descriptors exact = regular(1 / (6 * std::sqrt(2.0)), std::sqrt(3.0), std::sqrt(6.0) / 4);
  exact["feret_min"] = 1 / std::sqrt(2.0);
  exact["feret_max"] = 1;
  return exact;
}

/// Over a hexagon of edge 1.
Descriptors hexagonal_prism(double length) {
  const double base = 1.5 * std::sqrt(3.0), volume = base * length, area = 2 * base + 6 * length;
  return {{"volume", volume},
          {"surface_area", area},
          {"sphericity_wadell", wadell(volume, area)},
          {"feret_max", std::hypot(2, length)},
          {"feret_min", std::fmin(length, std::sqrt(3.0))},
          {"axis_long_obb", std::fmax(length, 2.0)},
          {"axis_short_obb", std::sqrt(3.0)},
          {"radius_inscribed", std::fmin(std::sqrt(3.0), length) / 2},
          {"radius_enclosing", std::hypot(2, length) / 2}};
}

double shortest_edge(const catalog::TriangleMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const catalog::Triangle& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const catalog::Point& a = mesh.vertices[static_cast<std::size_t>(face[k])];
      const catalog::Point& b = mesh.vertices[static_cast<std::size_t>(face[(k + 1) % 3])];
      least = std::fmin(least, std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
    }
  return least;
}

/// Scaled to edge 1 and turned off the axes.
catalog::TriangleMesh turned(catalog::TriangleMesh mesh) {
  const double edge = shortest_edge(mesh), c = std::cos(0.7), s = std::sin(0.7), d = std::cos(1.1), t = std::sin(1.1);
  for (catalog::Point& p : mesh.vertices) {
    const catalog::Point q{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
    p = {q[0] / edge, (d * q[1] - t * q[2]) / edge, (t * q[1] + d * q[2]) / edge};
  }
  return mesh;
}

double largest_error(const Descriptors& measured, const Descriptors& exact) {
  double largest = 0;
  for (const auto& [name, value] : exact) largest = std::fmax(largest, std::abs(measured.at(name) / value - 1));
  return largest;
}

constexpr double kAxes[] = {0.5, 0.8, 1.0};  // semi-axes of the ellipsoid

/// Area of the ellipsoid, by the midpoint rule over both angles: good to 3e-8.
double ellipsoid_area() {
  const double a = kAxes[2], b = kAxes[1], c = kAxes[0];
  constexpr int kAround = 400, kAlong = 4000;
  double sum = 0;
  for (int i = 0; i < kAlong; ++i) {
    const double polar = kPi * (i + 0.5) / kAlong, u = std::cos(polar), ring = std::sin(polar);
    for (int j = 0; j < kAround; ++j) {
      const double angle = 2 * kPi * j / kAround, x = ring * std::cos(angle), y = ring * std::sin(angle);
      sum += ring * std::sqrt(std::pow(b * c * x, 2) + std::pow(a * c * y, 2) + std::pow(a * b * u, 2));
    }
  }
  return sum * (kPi / kAlong) * (2 * kPi / kAround);
}

Descriptors ellipsoid_of(int detail) {
  return sp::shape_descriptors(sp::built_in_solid({"superquadric",
                                                   {{"e1", 1},
                                                    {"e2", 1},
                                                    {"a", kAxes[2]},
                                                    {"b", kAxes[1]},
                                                    {"c", kAxes[0]},
                                                    {"detail", static_cast<double>(detail)}},
                                                   1})
                                   .mesh);
}

/// Of meshes inscribed in the ellipsoid, extrapolated: their errors fall with the square of the edge.
double ellipsoid_error() {
  const Descriptors coarse = ellipsoid_of(16), middle = ellipsoid_of(32), fine = ellipsoid_of(64);
  const double volume = 4 * kPi / 3 * kAxes[0] * kAxes[1] * kAxes[2], area = ellipsoid_area();
  const Descriptors exact{{"volume", volume},
                          {"surface_area", area},
                          {"sphericity_wadell", wadell(volume, area)},
                          {"axis_short_inertia", 2 * kAxes[0]},
                          {"axis_intermediate_inertia", 2 * kAxes[1]},
                          {"axis_long_inertia", 2 * kAxes[2]},
                          {"equivalent_diameter_volume", std::cbrt(6 * volume / kPi)}};
  double largest = 0;
  for (const auto& [name, value] : exact) {
    const double first = (4 * middle.at(name) - coarse.at(name)) / 3,
                 second = (4 * fine.at(name) - middle.at(name)) / 3;
    largest = std::fmax(largest, std::abs((16 * second - first) / 15 / value - 1));
  }
  return largest;
}

}  // namespace

CaseResult measure_exact_descriptors() {
  const double five = std::sqrt(5.0);
  const std::pair<const char*, Descriptors> solids[] = {
      {"tetrahedron", tetrahedron()},
      {"cube", symmetric(1, 6, std::sqrt(3.0) / 2)},
      {"octahedron", symmetric(std::sqrt(2.0) / 3, 2 * std::sqrt(3.0), 1 / std::sqrt(2.0))},
      {"dodecahedron", symmetric((15 + 7 * five) / 4, 3 * std::sqrt(25 + 10 * five), std::sqrt(3.0) * (1 + five) / 4)},
      {"icosahedron", symmetric(5 * (3 + five) / 12, 5 * std::sqrt(3.0), std::sqrt(10 + 2 * five) / 4)},
      {"hexagonal-prism", hexagonal_prism(4)}};
  CaseResult result;
  for (const auto& [name, exact] : solids) {
    const Descriptors measured = sp::shape_descriptors(turned(sp::built_in_solid({name, {}, 1}).mesh));
    result.figures.push_back(
        {std::string(name) + ", largest relative error", largest_error(measured, exact), "-", at_most(kGoal), ""});
  }
  result.figures.push_back(
      {"ellipsoid, extrapolated over the edge, largest relative error", ellipsoid_error(), "-", at_most(kGoal), ""});
  return result;
}

}  // namespace workflows
