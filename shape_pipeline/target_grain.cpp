// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/target_grain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "shape_pipeline/described_shape.h"
#include "shape_pipeline/families/spherical_harmonics.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/solids/round_solids.h"
#include "shape_pipeline/surfaces/convex_hull.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kReached = 1e-3;              // error of convexity and sphericity: a tenth of a measured grain's
constexpr double kFineConvexity = 2e-4;        // so that the search for the sphericity is not led by its noise
constexpr int kDetail = 6;                     // faces along a quarter turn: 2.7 to the finest wave
constexpr int kLowestDegree = 3, kDegree = 9;  // 2 is the ellipsoid's
constexpr std::array kExponents{2.0, 0.0, 4.0, 8.0};
constexpr double kMostAmplitude = 0.8;  // beyond it radii differ tenfold
constexpr double kMostLevel = 1.5;      // beyond it one bump or dent is left
constexpr double kLevelStep = 0.5, kFirstAmplitude = 0.04;
constexpr int kSteps = 40;  // of one search; a dozen suffice

double convexity_of(const catalog::TriangleMesh& mesh) {
  return signed_volume(mesh) / signed_volume(convex_hull(mesh.vertices));
}

/// The sphere and its harmonics at each vertex, degree by degree.
struct UnitSphere {
  catalog::TriangleMesh mesh = superquadric_solid({}, kDetail).mesh;
  double convexity = convexity_of(mesh);
  std::vector<std::vector<double>> harmonics;

  UnitSphere() {
    for (const Point& x : mesh.vertices) harmonics.push_back(real_harmonics(normalized(x), kDegree));
  }
};

const UnitSphere& unit_sphere() {
  static const UnitSphere sphere;
  return sphere;
}

/// Brought to mean 0 and variance 1 over the vertices.
void standardise(std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (const double value : values) mean += value / count;
  for (double& value : values) {
    value -= mean;
    square += value * value / count;
  }
  for (double& value : values) value /= std::sqrt(square);
}

std::vector<double> gaussian_field(RandomStream& random, double exponent) {
  std::vector<double> coefficients;
  for (int degree = 0; degree <= kDegree; ++degree)
    for (int order = -degree; order <= degree; ++order)
      coefficients.push_back(
          degree < kLowestDegree ? 0 : random.normal() * std::pow(degree, -exponent / 2) / std::sqrt(2 * degree + 1));
  std::vector<double> field;
  for (const std::vector<double>& harmonics : unit_sphere().harmonics) {
    double sum = 0;
    for (std::size_t k = 0; k < coefficients.size(); ++k) sum += coefficients[k] * harmonics[k];
    field.push_back(sum);
  }
  standardise(field);
  return field;
}

/// Bounded, so that no grain has needles or pinholes: all its bumps are as high as one another, its dents as deep.
std::vector<double> relief(std::vector<double> field, double level) {
  for (double& value : field) value = std::tanh(value - level);
  standardise(field);
  return field;
}

catalog::TriangleMesh surface(const std::vector<double>& field, double amplitude) {
  catalog::TriangleMesh mesh = unit_sphere().mesh;
  for (std::size_t v = 0; v < field.size(); ++v)
    mesh.vertices[v] = scaled(mesh.vertices[v], std::exp(amplitude * field[v]));
  return mesh;
}

double sphericity_of(const catalog::TriangleMesh& mesh) {
  return std::cbrt(std::numbers::pi) * std::pow(6 * signed_volume(mesh), 2.0 / 3) / surface_area(mesh);
}

/// By one linear map: a map T turns the tensor of second moments M into T M T^T.
catalog::TriangleMesh with_axes(catalog::TriangleMesh mesh, const GrainForm& form) {
  const catalog::MassProperties solid = catalog::mass_properties(mesh);
  const Point& moment = solid.principal_inertia;  // ascending: about the longest axis first
  const double half_trace = (moment[0] + moment[1] + moment[2]) / 2;
  const Point wanted{1, form.i_over_l, form.i_over_l * form.s_over_i};
  for (Point& vertex : mesh.vertices) {
    const Point x = subtract(vertex, solid.centroid);
    for (int k = 0; k < 3; ++k)
      vertex[k] = dot(solid.principal_axes[k], x) * wanted[k] / std::sqrt(half_trace - moment[k]);
  }
  return scaled_to_volume(std::move(mesh), std::numbers::pi / 6 * std::pow(form.diameter, 3));
}

struct Trial {
  double place = 0, error = 0;
};

/// Between two trials of errors of opposite sign: false position, the end that stays weighed down (Illinois: Dowell &
/// Jarratt 1971). Returns the last trial, whose error is at most `tolerance` unless the error jumps.
Trial root_between(Trial low, Trial high, double tolerance, const std::function<double(double)>& error_at) {
  Trial last = std::abs(low.error) < std::abs(high.error) ? low : high;
  int side = 0;  // that was moved last
  for (int step = 0; step < kSteps && std::abs(last.error) > tolerance; ++step) {
    const double place = (low.place * high.error - high.place * low.error) / (high.error - low.error);
    last = {place, error_at(place)};
    const bool is_low = (last.error < 0) == (low.error < 0);
    (is_low ? low : high) = last;
    if (side == (is_low ? -1 : 1)) (is_low ? high : low).error /= 2;
    side = is_low ? -1 : 1;
  }
  return last;
}

/// One random field, bent and scaled until the grain has the form.
class Search {
 public:
  Search(const GrainForm& form, std::vector<double> field) : form_(form), field_(std::move(field)) {}

  TargetGrain nearest() {
    const Trial middle{0, error_at(0)};
    // At equal convexity a body with bumps has less surface than one with dents, unless its bumps are its corners.
    const double first = middle.error > 0 ? -kLevelStep : kLevelStep;
    for (const double step : {first, -first})
      if (std::abs(best_.sphericity_error) > kReached && walked(middle, step)) break;
    return best_;
  }

 private:
  /// Whether the error changes its sign on the way, which ends where it grows; the nearest is then known.
  bool walked(Trial last, double step) {
    for (double level = last.place + step; std::abs(level) <= kMostLevel; level += step) {
      const Trial next{level, error_at(level)};
      if ((next.error < 0) != (last.error < 0)) {
        root_between(last, next, kReached, [&](double place) { return error_at(place); });
        return true;
      }
      if (std::abs(next.error) > std::abs(last.error)) return false;
      last = next;
    }
    return false;
  }

  /// Of the sphericity at this level; keeps the nearest grain.
  double error_at(double level) {
    const std::vector<double> field = relief(field_, level);
    const Trial amplitude = amplitude_for(field);
    TargetGrain grain{with_axes(surface(field, amplitude.place), form_), amplitude.error, 0, amplitude.place, level};
    grain.sphericity_error = sphericity_of(grain.mesh) - form_.sphericity;
    const double error = grain.sphericity_error;
    if (best_.mesh.vertices.empty() || miss(grain) < miss(best_)) best_ = std::move(grain);
    return error;
  }

  static double miss(const TargetGrain& grain) { return std::hypot(grain.convexity_error, grain.sphericity_error); }

  /// The least amplitude that gives the convexity, or where it comes nearest, with the error of the convexity.
  Trial amplitude_for(const std::vector<double>& field) {
    const auto error_at = [&](double amplitude) { return convexity_of(surface(field, amplitude)) - form_.convexity; };
    Trial low{0, unit_sphere().convexity - form_.convexity};
    if (low.error <= kFineConvexity) return low;
    Trial high{guess_, error_at(guess_)};
    while (high.error > kFineConvexity && high.place < kMostAmplitude) {
      low = high;
      high.place *= 1.5;
      high.error = error_at(high.place);
    }
    const Trial found = high.error > 0 ? high : root_between(low, high, kFineConvexity, error_at);
    guess_ = std::clamp(1.05 * found.place, 1e-3, kMostAmplitude);
    return found;
  }

  GrainForm form_;
  std::vector<double> field_;
  double guess_ = kFirstAmplitude;
  TargetGrain best_;
};

void refuse_impossible(const GrainForm& form) {
  const auto refuse = [](const char* name, double value, const char* expected) {
    char text[160];
    std::snprintf(text, sizeof text, "form of a grain: %s is %g, expected %s", name, value, expected);
    throw catalog::InputError(text);
  };
  if (!(form.diameter > 0 && std::isfinite(form.diameter))) refuse("diameter", form.diameter, "a length above 0");
  for (const auto& [name, value] : {std::pair("s_over_i", form.s_over_i), std::pair("i_over_l", form.i_over_l),
                                    std::pair("convexity", form.convexity), std::pair("sphericity", form.sphericity)})
    if (!(value >= 0.01 && std::isfinite(value))) refuse(name, value, "a ratio of at least 0.01");
  if (form.s_over_i > 1 || form.i_over_l > 1)
    refuse("a ratio of axes", std::max(form.s_over_i, form.i_over_l), "at most 1");
}

}  // namespace

bool TargetGrain::is_reached() const {
  return std::abs(convexity_error) <= kReached && std::abs(sphericity_error) <= kReached;
}

TargetGrain target_grain(const GrainForm& form, std::uint64_t seed) {
  refuse_impossible(form);
  RandomStream random(seed);
  TargetGrain best;
  double least = std::numeric_limits<double>::infinity();
  int fields = 0;
  for (const double exponent : kExponents) {
    TargetGrain grain = Search(form, gaussian_field(random, exponent)).nearest();
    grain.exponent = exponent;
    ++fields;
    const double miss = std::hypot(grain.convexity_error, grain.sphericity_error);
    if (miss < least) {
      least = miss;
      best = std::move(grain);
    }
    if (best.is_reached()) break;
  }
  best.fields = fields;
  return best;
}

}  // namespace shape_pipeline
