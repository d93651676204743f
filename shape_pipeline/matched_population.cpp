// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/matched_population.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <numeric>

#include "catalog/input_error.h"
#include "shape_pipeline/micrographs/plane_geometry.h"
#include "shape_pipeline/micrographs/silhouette.h"
#include "shape_pipeline/solids/round_solids.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr char kSize[] = "equivalent_diameter";
constexpr double kFormPixels = 20;  // diameter from which on an outline tells a form
constexpr std::size_t kFewestForms = 10;
constexpr int kLowestWave = 3, kHighestWave = 12;  // 1 is the centre's place, 2 the ellipse
constexpr int kWaves = 24;                         // plane waves of one grain
constexpr int kRays = 128;
constexpr int kViews = 6;                     // silhouettes of each grain
constexpr int kPilotGrains = 48;              // on which power and amplitude are found
constexpr int kPilotDetail = 4, kDetail = 8;  // faces along a quarter turn
constexpr int kHalvings = 10, kRounds = 2;
constexpr double kMostFactor = 4;

/// Deviation of the outline's radii from those of its ellipse, over them.
std::vector<double> deviations(const Outline& given) {
  const Outline outline = with_positive_area(given);
  const PlaneMoments moments = plane_moments(outline);
  const FittedEllipse ellipse = fitted_ellipse(moments);
  std::vector<double> radii = ray_radii(outline, moments.centroid, kRays);
  for (int k = 0; k < kRays; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRays - ellipse.angle;
    const double radius = 0.5 / std::hypot(std::cos(angle) / ellipse.major, std::sin(angle) / ellipse.minor);
    radii[static_cast<std::size_t>(k)] = radii[static_cast<std::size_t>(k)] / radius - 1;
  }
  return radii;
}

using Spectrum = std::array<double, kHighestWave + 1>;

/// Power of the deviations by wave number, from the lowest to the highest that count.
Spectrum spectrum_of(const Outline& outline) {
  static const std::array<double, kRays> cosines = [] {
    std::array<double, kRays> table{};
    for (std::size_t k = 0; k < kRays; ++k) table[k] = std::cos(2 * std::numbers::pi * static_cast<double>(k) / kRays);
    return table;
  }();
  const std::vector<double> values = deviations(outline);
  Spectrum spectrum{};
  for (std::size_t wave = kLowestWave; wave <= kHighestWave; ++wave) {
    double cosine = 0, sine = 0;
    for (std::size_t k = 0; k < kRays; ++k) {
      cosine += values[k] * cosines[wave * k % kRays];
      sine += values[k] * cosines[(wave * k + 3 * kRays / 4) % kRays];
    }
    spectrum[wave] = 2 * (cosine * cosine + sine * sine) / (static_cast<double>(kRays) * kRays);
  }
  return spectrum;
}

/// What one outline shows.
struct Seen {
  OutlineForm form;
  double roughness = 0;  // root mean square of its deviations from its ellipse, over its radius
  bool has_form = true;
};

Seen seen_of(const Outline& outline, Spectrum& spectrum) {
  spectrum = spectrum_of(outline);
  return {outline_form(outline), std::sqrt(std::accumulate(spectrum.begin(), spectrum.end(), 0.0))};
}

Seen seen_of(const Outline& outline) {
  Spectrum unused;
  return seen_of(outline, unused);
}

/// All outlines, and the chance of each wave number.
struct Sample {
  std::vector<Seen> seen;
  std::vector<std::size_t> forms;  // those that show one
  Spectrum power{};
};

Sample sample_of(const std::vector<Outline>& outlines, double pixel) {
  Sample sample;
  for (const Outline& outline : outlines) {
    Spectrum spectrum;
    Seen seen = seen_of(outline, spectrum);
    seen.has_form = seen.form.equivalent_diameter >= kFormPixels * pixel;
    for (std::size_t wave = 0; wave < spectrum.size() && seen.has_form; ++wave) sample.power[wave] += spectrum[wave];
    sample.seen.push_back(seen);
  }
  std::stable_sort(sample.seen.begin(), sample.seen.end(), [](const Seen& a, const Seen& b) {
    return a.form.equivalent_diameter < b.form.equivalent_diameter;
  });
  for (std::size_t k = 0; k < sample.seen.size(); ++k)
    if (sample.seen[k].has_form) sample.forms.push_back(k);
  if (sample.forms.size() < kFewestForms)
    throw catalog::InputError("population: " + std::to_string(sample.forms.size()) +
                              " whole outlines of 20 pixels or more, expected 10 at least; take more micrographs, or "
                              "larger ones, or give --population 0");
  return sample;
}

std::size_t drawn(RandomStream& random, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
}

struct Wave {
  Point direction{};
  double number = 0, phase = 0;
};

/// What is drawn of a grain before p and amplitude are known.
struct Draft {
  double diameter = 0;                // [m] that its silhouettes are to have
  double ratio = 1, other_ratio = 1;  // seen aspect ratios, for I/L and S/I
  double roughness = 0;
  std::vector<Wave> waves;
  std::vector<Point> views;
  std::vector<double> field;  // at the vertices of the unit sphere
};

/// The k-th of n grains, from the smallest up: systematic sampling, so that few grains have the sizes of all outlines.
Draft draft_of(const Sample& sample, int k, int n, RandomStream& random) {
  Draft draft;
  const double place = (k + random.uniform()) / n * static_cast<double>(sample.seen.size());
  const std::size_t first = std::min(sample.seen.size() - 1, static_cast<std::size_t>(place));
  const std::size_t form = sample.seen[first].has_form ? first : sample.forms[drawn(random, sample.forms.size())];
  const std::size_t other = sample.forms[drawn(random, sample.forms.size())];
  draft.diameter = sample.seen[first].form.equivalent_diameter;
  draft.ratio = sample.seen[form].form.aspect_ratio;
  draft.other_ratio = sample.seen[other].form.aspect_ratio;
  draft.roughness = sample.seen[form].roughness;
  double all = 0;
  for (const double power : sample.power) all += power;
  for (int wave = 0; wave < kWaves; ++wave) {
    double left = random.uniform() * all;
    int number = kLowestWave;
    for (; number < kHighestWave && left >= sample.power[static_cast<std::size_t>(number)]; ++number)
      left -= sample.power[static_cast<std::size_t>(number)];
    draft.waves.push_back({random.direction(), static_cast<double>(number), random.uniform(0, 2 * std::numbers::pi)});
  }
  for (int view = 0; view < kViews; ++view) draft.views.push_back(random.direction());
  return draft;
}

/// The sum of the waves over the sphere, of variance 1.
void set_field(Draft& draft, const catalog::TriangleMesh& sphere) {
  draft.field.clear();
  for (const Point& x : sphere.vertices) {
    double sum = 0;
    for (const Wave& wave : draft.waves) sum += std::cos(wave.number * dot(wave.direction, x) + wave.phase);
    draft.field.push_back(sum * std::sqrt(2.0 / kWaves));
  }
}

struct Form {
  double power = 1, amplitude = 1, third_axis = 0;
};

struct MadeGrain {
  catalog::TriangleMesh mesh;
  std::vector<Seen> silhouettes;
};

/// The grain whose silhouettes have, on the mean over its views, the size drawn.
MadeGrain made_grain(const Draft& draft, const Form& form, const catalog::TriangleMesh& sphere) {
  const double i_over_l = std::pow(draft.ratio, form.power);
  const double s_over_i = form.third_axis > 0 ? form.third_axis : std::pow(draft.other_ratio, form.power);
  MadeGrain grain{sphere, {}};
  for (std::size_t v = 0; v < sphere.vertices.size(); ++v) {
    const Point& x = sphere.vertices[v];
    const double radius = std::exp(form.amplitude * draft.roughness * draft.field[v]);
    grain.mesh.vertices[v] = {radius * x[0], radius * i_over_l * x[1], radius * i_over_l * s_over_i * x[2]};
  }
  double mean = 0;
  for (const Point& view : draft.views) {
    grain.silhouettes.push_back(seen_of(star_silhouette(grain.mesh, view, kRays)));
    mean += grain.silhouettes.back().form.equivalent_diameter / kViews;
  }
  const double scale = draft.diameter / mean;
  for (Point& vertex : grain.mesh.vertices) vertex = scaled(vertex, scale);
  for (Seen& silhouette : grain.silhouettes) silhouette.form.equivalent_diameter *= scale;
  return grain;
}

struct Moments {
  double mean = 0, spread = 0;
};

using Figure = std::function<double(const Seen&)>;

Moments moments_of(const std::vector<Seen>& all, const Figure& figure) {
  Moments result;
  for (const Seen& seen : all) result.mean += figure(seen) / static_cast<double>(all.size());
  for (const Seen& seen : all)
    result.spread += std::pow(figure(seen) - result.mean, 2) / static_cast<double>(all.size());
  result.spread = std::sqrt(result.spread);
  return result;
}

double size_seen(const Seen& seen) { return seen.form.equivalent_diameter; }
double aspect_seen(const Seen& seen) { return seen.form.aspect_ratio; }
double roughness_seen(const Seen& seen) { return seen.roughness; }
double solidity_seen(const Seen& seen) { return seen.form.solidity; }
double circularity_seen(const Seen& seen) { return seen.form.circularity; }

/// The grains on which power and amplitude are found.
struct Pilot {
  std::vector<Draft> drafts;
  catalog::TriangleMesh sphere;

  double mean(const Form& form, const Figure& figure) const {
    std::vector<Seen> all;
    for (const Draft& draft : drafts)
      for (const Seen& silhouette : made_grain(draft, form, sphere).silhouettes) all.push_back(silhouette);
    return moments_of(all, figure).mean;
  }
};

/// Where between 0 and kMostFactor a growing function meets the target.
double halved(const std::function<double(double)>& growing, double target) {
  double low = 0, high = kMostFactor;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    (growing(middle) < target ? low : high) = middle;
  }
  return (low + high) / 2;
}

Form fitted_form(const Sample& sample, const PopulationOptions& options) {
  Pilot pilot{{}, superquadric_solid({}, kPilotDetail).mesh};
  RandomStream random(options.seed);
  for (int k = 0; k < kPilotGrains; ++k) {
    pilot.drafts.push_back(draft_of(sample, k, kPilotGrains, random));
    set_field(pilot.drafts.back(), pilot.sphere);
  }
  Form form;
  form.third_axis = options.third_axis;
  // What these very grains' outlines showed, so that the chance of the draw is not fitted.
  double aspect = 0, roughness = 0;
  for (const Draft& draft : pilot.drafts) {
    aspect += draft.ratio / kPilotGrains;
    roughness += draft.roughness / kPilotGrains;
  }
  for (int round = 0; round < kRounds; ++round) {
    form.power = halved(
        [&](double power) {
          return -pilot.mean({power, form.amplitude, form.third_axis}, aspect_seen);
        },
        -aspect);
    form.amplitude = halved(
        [&](double amplitude) {
          return pilot.mean({form.power, amplitude, form.third_axis}, roughness_seen);
        },
        roughness);
  }
  return form;
}

std::string assumption_text(const PopulationOptions& options) {
  if (options.third_axis == 0)
    return "third axis not seen: S/I drawn from the same distribution as I/L, independently of it; random orientation";
  char text[120];
  std::snprintf(text, sizeof text, "third axis not seen: S/I = %g for every grain, as given; random orientation",
                options.third_axis);
  return text;
}

}  // namespace

bool FormComparison::agrees(int count) const {
  const double finest = name == kSize ? 0 : 0.005;  // ratios are not known better
  return std::abs(made_mean - measured_mean) <= 0.02 * measured_mean + finest + 3 * made_spread / std::sqrt(count);
}

MatchedPopulation matched_population(const std::vector<Outline>& outlines, double pixel,
                                     const PopulationOptions& options) {
  const Sample sample = sample_of(outlines, pixel);
  std::vector<Seen> forms, made;
  for (const std::size_t k : sample.forms) forms.push_back(sample.seen[k]);
  const Form form = fitted_form(sample, options);
  MatchedPopulation population;
  population.ratio_power = form.power;
  population.roughness_factor = form.amplitude;
  population.assumption = assumption_text(options);
  const catalog::TriangleMesh sphere = superquadric_solid({}, kDetail).mesh;
  RandomStream random(options.seed + 0x9e3779b97f4a7c15u);  // other grains than the pilot's
  for (int k = 0; k < options.count; ++k) {
    Draft draft = draft_of(sample, k, options.count, random);
    set_field(draft, sphere);
    MadeGrain grain = made_grain(draft, form, sphere);
    made.insert(made.end(), grain.silhouettes.begin(), grain.silhouettes.end());
    population.grains.push_back(std::move(grain.mesh));
  }
  const auto compare = [&](const char* name, const std::vector<Seen>& measured, const Figure& figure) {
    const Moments seen = moments_of(measured, figure), shown = moments_of(made, figure);
    population.comparison.push_back({name, seen.mean, seen.spread, shown.mean, shown.spread});
  };
  compare(kSize, sample.seen, size_seen);
  compare("aspect_ratio", forms, aspect_seen);
  compare("roughness", forms, roughness_seen);
  compare("solidity", forms, solidity_seen);
  compare("circularity", forms, circularity_seen);
  return population;
}

}  // namespace shape_pipeline
