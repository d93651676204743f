// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/described_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/input_error.h"
#include "shape_pipeline/digitization.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/self_intersections.h"
#include "shape_pipeline/shape_descriptors.h"
#include "shape_pipeline/solid_checks.h"
#include "shape_pipeline/surfaces/convex_hull.h"
#include "shape_pipeline/surfaces/minimum_box.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kLeastHullRatio = 0.01;  // thin arms and rings fill little of their hull, and are meant to

double size_of(const catalog::TriangleMesh& mesh, SizeDefinition definition) {
  if (definition == SizeDefinition::volume) return std::cbrt(6 * signed_volume(mesh) / std::numbers::pi);
  const catalog::TriangleMesh hull = convex_hull(mesh.vertices);
  if (definition == SizeDefinition::sieve) {
    Point axis = minimum_volume_box(hull).extent;
    std::sort(axis.begin(), axis.end());
    return axis[1];
  }
  double largest = 0;
  for (const Point& a : hull.vertices)
    for (const Point& b : hull.vertices) largest = std::max(largest, distance(a, b));
  return largest;
}

catalog::TriangleMesh scaled_by(catalog::TriangleMesh mesh, double factor) {
  for (Point& vertex : mesh.vertices) vertex = scaled(vertex, factor);
  return mesh;
}

}  // namespace

catalog::ShapeRecord described_shape(const catalog::TriangleMesh& mesh, int genus) {
  catalog::ShapeRecord shape = in_principal_frame(mesh);
  SolidExpectation expectation;
  expectation.genus = genus;
  expectation.least_hull_ratio = kLeastHullRatio;
  shape.checks = solid_checks(shape.mesh, expectation);
  const std::size_t crossings = count_self_intersections(shape.mesh);
  shape.checks.push_back({"self_intersections", crossings == 0, static_cast<double>(crossings),
                          "pairs of faces that cut one another, expected 0"});
  shape.descriptors = shape_descriptors(shape.mesh);
  return shape;
}

SizeDefinition size_definition(const std::string& word) {
  if (word == "sieve") return SizeDefinition::sieve;
  if (word == "volume") return SizeDefinition::volume;
  if (word == "feret") return SizeDefinition::feret;
  throw catalog::InputError("size definition: expected 'sieve', 'volume' or 'feret', found '" + word + "'");
}

catalog::TriangleMesh scaled_to_size(const catalog::TriangleMesh& mesh, double size, SizeDefinition definition) {
  return scaled_by(mesh, size / size_of(mesh, definition));
}

catalog::TriangleMesh scaled_to_volume(catalog::TriangleMesh mesh, double volume) {
  const double factor = std::cbrt(volume / signed_volume(mesh));
  return scaled_by(std::move(mesh), factor);
}

}  // namespace shape_pipeline
