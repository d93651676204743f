// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/shape_families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "shape_pipeline/described_shape.h"
#include "shape_pipeline/digitization.h"
#include "shape_pipeline/families/hull_blend.h"
#include "shape_pipeline/families/smoothing.h"
#include "shape_pipeline/families/spherical_harmonics.h"
#include "shape_pipeline/mesh_remeshing.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/self_intersections.h"
#include "shape_pipeline/surfaces/convex_hull.h"
#include "shape_pipeline/surfaces/corner_measure.h"
#include "shape_pipeline/surfaces/inscribed_sphere.h"
#include "shape_pipeline/surfaces/minimum_box.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kRatioTolerance = 1e-6;     // of S/I and I/L
constexpr int kMostStretches = 60;           // the box turns a little with each
constexpr std::size_t kFacesToShape = 6000;  // rounding needs faces well below the corners' scale
constexpr int kRoundSteps = 300;             // smooth over about half the radius
constexpr double kRoundShare = 0.5, kSharpest = 3;
constexpr double kDeepest = 4;  // times the way to the hull: hollows five times as deep
constexpr int kHalvings = 24;

std::string text(const char* format, double a, double b = 0, double c = 0, double d = 0) {
  char line[240];
  std::snprintf(line, sizeof line, format, a, b, c, d);
  return line;
}

/// The box of least volume, its axes by ascending extent.
OrientedBox sorted_box(const catalog::TriangleMesh& mesh) {
  const OrientedBox box = minimum_volume_box(convex_hull(mesh.vertices));
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return box.extent[a] < box.extent[b]; });
  OrientedBox sorted;
  for (int i = 0; i < 3; ++i) {
    sorted.axes[i] = box.axes[order[i]];
    sorted.extent[i] = box.extent[order[i]];
  }
  return sorted;
}

double angularity_of(const catalog::TriangleMesh& mesh) {
  const auto corners = corner_measure(mesh, inscribed_sphere(mesh).radius);
  if (!corners)
    throw catalog::InputError("angularity: the shape is too thin for its corners to be measured; stretch it last");
  return corners->angularity;
}

catalog::TriangleMesh blended(const catalog::TriangleMesh& round, const catalog::TriangleMesh& given, double t) {
  catalog::TriangleMesh result = given;
  for (std::size_t v = 0; v < result.vertices.size(); ++v)
    result.vertices[v] = add(round.vertices[v], scaled(subtract(given.vertices[v], round.vertices[v]), t));
  return scaled_to_volume(std::move(result), signed_volume(given));
}

double convexity_of(const catalog::TriangleMesh& mesh) {
  return signed_volume(mesh) / signed_volume(convex_hull(mesh.vertices));
}

/// What a family's figure is to become, and the range of the parameter that changes it.
struct Target {
  const char* name;
  double value, tolerance, low, high;
};

/// The shape make(t) whose figure, measure(shape), is the target's, by halving; towards `high` the figure grows, or
/// falls, and the surface may come to cut itself, which is no shape: the search goes on below.
template <class Make, class Measure>
FamilyMember found_shape(const Target& target, const Make& make, const Measure& measure, bool grows = true) {
  FamilyMember best;
  double nearest = std::numeric_limits<double>::infinity(), taken = 0, low = target.low, high = target.high;
  const auto is_beyond = [&](double t) {
    // Measured in the frame in which it is stored: the points at which corners are looked at depend on it a little.
    catalog::TriangleMesh candidate = in_principal_frame(make(t)).mesh;
    if (count_self_intersections(candidate) > 0) return true;
    const double figure = measure(candidate);
    if (std::abs(figure - target.value) < std::abs(nearest - target.value)) {
      nearest = figure;
      taken = t;
      best.mesh = std::move(candidate);
    }
    return grows ? figure >= target.value : figure <= target.value;
  };
  is_beyond(low);
  is_beyond(high);
  for (int step = 0; step < kHalvings && std::abs(nearest - target.value) > target.tolerance; ++step) {
    const double middle = (low + high) / 2;
    (is_beyond(middle) ? high : low) = middle;
  }
  if (!(std::abs(nearest - target.value) <= target.tolerance))
    throw catalog::InputError(target.name + text(" %g is not reached; the nearest is %.4f", target.value, nearest) +
                              " without the surface cutting itself; ask for that, or begin with another shape");
  best.checks.push_back({std::string(target.name) + "_error", true, nearest - target.value,
                         text("expected at most %g; parameter of the blend %.4f", target.tolerance, taken)});
  return best;
}

}  // namespace

bool is_star_shaped(const catalog::TriangleMesh& mesh) {
  return std::all_of(mesh.faces.begin(), mesh.faces.end(), [&](const catalog::Triangle& face) {
    return dot(mesh.vertices[face[0]], cross(mesh.vertices[face[1]], mesh.vertices[face[2]])) > 0;
  });
}

FamilyMember stretched(const catalog::TriangleMesh& mesh, double s_over_i, double i_over_l) {
  for (const auto& [name, value] : {std::pair("S/I", s_over_i), std::pair("I/L", i_over_l)})
    if (!(value >= 0.01 && value <= 1))
      throw catalog::InputError(std::string(name) + ": expected a ratio of 0.01 to 1 (S is the shortest side, L the " +
                                "longest), found " + text("%g", value));
  FamilyMember member{mesh, {}};
  const double volume = signed_volume(mesh);
  double error = std::numeric_limits<double>::infinity();
  OrientedBox box = sorted_box(member.mesh);
  for (int step = 0; step < kMostStretches; ++step) {
    const auto& [s, i, l] = box.extent;
    error = std::max(std::abs(s / i - s_over_i), std::abs(i / l - i_over_l));
    if (error <= kRatioTolerance) break;
    const Point factor{s_over_i * i_over_l / s, i_over_l / i, 1 / l};
    for (Point& p : member.mesh.vertices) {
      Point moved{};
      for (int k = 0; k < 3; ++k) moved = add(moved, scaled(box.axes[k], factor[k] * dot(box.axes[k], p)));
      p = moved;
    }
    member.mesh = scaled_to_volume(std::move(member.mesh), volume);
    box = sorted_box(member.mesh);
  }
  if (error > kRatioTolerance)
    throw catalog::InputError(text("S/I %g and I/L %g are not reached; the nearest are %.4f and %.4f", s_over_i,
                                   i_over_l, box.extent[0] / box.extent[1], box.extent[1] / box.extent[2]) +
                              ": its box of least volume turns as it is stretched; ask for other ratios");
  member.checks.push_back({"stretch_ratio_error", true, error, "largest error of S/I and I/L, expected at most 1e-6"});
  return member;
}

FamilyMember with_angularity(const catalog::TriangleMesh& mesh, double target, double tolerance) {
  if (!(target >= 0 && target < 1))
    throw catalog::InputError("angularity: expected 0 to 1, found " + text("%g", target));
  if (!(tolerance >= 1e-4))
    throw catalog::InputError("angularity: expected a tolerance of at least 0.0001, found " + text("%g", tolerance));
  const catalog::TriangleMesh given =
      scaled_to_volume(remesh(mesh, {kFacesToShape, RemeshingStyle::isotropic}).mesh, signed_volume(mesh));
  const catalog::TriangleMesh round = umbrella_steps(given, kRoundShare, kRoundSteps);
  return found_shape(
      {"angularity", target, tolerance, 0, kSharpest}, [&](double t) { return blended(round, given, t); },
      angularity_of);
}

FamilyMember with_convexity(const catalog::TriangleMesh& mesh, double target, double tolerance) {
  if (!(target > 0 && target <= 1))
    throw catalog::InputError("convexity: expected a number above 0, at most 1, found " + text("%g", target));
  if (!(tolerance >= 1e-4))
    throw catalog::InputError("convexity: expected a tolerance of at least 0.0001, found " + text("%g", tolerance));
  const catalog::TriangleMesh given =
      scaled_to_volume(remesh(mesh, {kFacesToShape, RemeshingStyle::isotropic}).mesh, signed_volume(mesh));
  const std::vector<Point> ways = ways_to_hull(given);
  const auto deepened = [&](double t) {
    catalog::TriangleMesh result = given;
    for (std::size_t v = 0; v < ways.size(); ++v) result.vertices[v] = subtract(result.vertices[v], scaled(ways[v], t));
    return scaled_to_volume(std::move(result), signed_volume(given));
  };
  return found_shape({"convexity", target, tolerance, -1, kDeepest}, deepened, convexity_of, false);
}

FamilyMember low_passed(const catalog::TriangleMesh& mesh, int degree) {
  if (degree < 1 || degree > 30) throw catalog::InputError("degree: expected 1 to 30, found " + text("%.0f", degree));
  const auto coefficients = static_cast<std::size_t>((degree + 1) * (degree + 1));
  if (mesh.vertices.size() < 2 * coefficients)
    throw catalog::InputError(text("degree %.0f has %.0f coefficients, and the mesh only %.0f vertices", degree,
                                   static_cast<double>(coefficients), static_cast<double>(mesh.vertices.size())) +
                              "; expected twice as many: use a lower degree or a finer mesh");
  const double volume = signed_volume(mesh), radius = std::cbrt(3 * volume / (4 * std::numbers::pi));
  const bool is_star = is_star_shaped(mesh);
  FamilyMember member;
  member.mesh =
      scaled_to_volume(is_star ? harmonic_low_pass(mesh, degree) : taubin_low_pass(mesh, degree / radius), volume);
  double squares = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    squares += std::pow(distance(mesh.vertices[v], member.mesh.vertices[v]), 2);
  const double change = std::sqrt(squares / static_cast<double>(mesh.vertices.size())) / radius;
  member.checks.push_back({is_star ? "low_pass_spherical_harmonics" : "low_pass_taubin", true, change,
                           "root mean square change of the vertices over the radius of equal volume [-]"});
  return member;
}

}  // namespace shape_pipeline
