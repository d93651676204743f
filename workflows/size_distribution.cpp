// SPDX-License-Identifier: Apache-2.0
#include "workflows/size_distribution.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace workflows {
namespace {

// Nodes that stand for a closed form: the chord of a smooth curve is then off by less than 1e-6.
constexpr int kCurveNodes = 1024;
// Longest table whose nodes are reported as they are.
constexpr std::size_t kShortTable = 40;
constexpr int kReportedShares = 20;

double cube(double x) { return x * x * x; }

/// One class of a distribution: share p spread evenly over sizes a..b, or all at a if b = a.
struct SizeClass {
  SizeBasis basis;
  double a, b;  // [m]
  double p;     // share on the distribution's basis

  bool is_single_size() const { return !(b > a); }

  // Numbers are relative: a particle of size d counts 1, and has mass d^3.
  double number() const { return basis == SizeBasis::mass ? p * (a + b) / (2 * a * a * b * b) : p; }
  double mass() const { return basis == SizeBasis::mass ? p : p * (a + b) * (a * a + b * b) / 4; }

  /// Part of the class below x, a <= x <= b.
  SizeClass below(double x) const { return is_single_size() ? *this : SizeClass{basis, a, x, p * (x - a) / (b - a)}; }

  /// Mass of the smallest particles of the class that make up `t` of its number.
  double mass_of_smallest(double t) const {
    if (is_single_size()) return t * cube(a);
    const double density = p / (b - a);
    const double x = basis == SizeBasis::mass ? 1 / std::sqrt(std::max(1 / (a * a) - 2 * t / density, 1 / (b * b)))
                                              : std::min(a + t / density, b);
    return below(x).mass();
  }
};

std::vector<SizeClass> classes_of(const SizeDistribution& distribution) {
  std::vector<SizeClass> classes;
  for (std::size_t i = 1; i < distribution.size.size(); ++i) {
    const double share = distribution.passing[i] - distribution.passing[i - 1];
    if (share > 0) classes.push_back({distribution.basis, distribution.size[i - 1], distribution.size[i], share});
  }
  return classes;
}

double sum(const std::vector<SizeClass>& classes, double (SizeClass::*measure)() const) {
  return std::accumulate(classes.begin(), classes.end(), 0.0,
                         [&](double total, const SizeClass& one) { return total + (one.*measure)(); });
}

SizeDistribution curve(SizeBasis basis, double least, double most, const std::function<double(double)>& cumulative) {
  SizeDistribution distribution{basis, {}, {}};
  const double low = cumulative(least), high = cumulative(most);
  for (int i = 0; i <= kCurveNodes; ++i) {
    const double size = i == kCurveNodes ? most : least * std::pow(most / least, double(i) / kCurveNodes);
    distribution.size.push_back(size);
    distribution.passing.push_back(std::clamp((cumulative(size) - low) / (high - low), 0.0, 1.0));
  }
  return distribution;
}

}  // namespace

const char* name_of(SizeBasis basis) { return basis == SizeBasis::mass ? "mass" : "number"; }

const char* name_of(SizeDefinition definition) {
  switch (definition) {
    case SizeDefinition::sieve:
      return "sieve";
    case SizeDefinition::volume_equivalent:
      return "volume-equivalent";
    case SizeDefinition::max_feret:
      return "max-feret";
  }
  return "";
}

SizeDistribution single_size(double size) { return {SizeBasis::mass, {size, size}, {0, 1}}; }

SizeDistribution rosin_rammler(SizeBasis basis, double d63, double spread, double least, double most) {
  return curve(basis, least, most, [&](double size) { return -std::expm1(-std::pow(size / d63, spread)); });
}

SizeDistribution lognormal(SizeBasis basis, double d50, double geometric_deviation, double least, double most) {
  const double width = std::log(geometric_deviation) * std::numbers::sqrt2;
  return curve(basis, least, most, [&](double size) { return 0.5 * std::erfc(-std::log(size / d50) / width); });
}

double passing(const SizeDistribution& distribution, double size, SizeBasis basis) {
  const auto measure = basis == SizeBasis::mass ? &SizeClass::mass : &SizeClass::number;
  double below = 0, all = 0;
  for (const SizeClass& one : classes_of(distribution)) {
    const double whole = (one.*measure)();
    all += whole;
    if (size >= one.b)
      below += whole;
    else if (size > one.a)
      below += (one.below(size).*measure)();
  }
  return below / all;
}

double mean_cubed_size(const SizeDistribution& distribution) {
  const std::vector<SizeClass> classes = classes_of(distribution);
  return sum(classes, &SizeClass::mass) / sum(classes, &SizeClass::number);
}

std::vector<double> sample_sizes(const SizeDistribution& distribution, int count) {
  const std::vector<SizeClass> classes = classes_of(distribution);
  const double stratum = sum(classes, &SizeClass::number) / count;
  std::vector<double> sizes;
  sizes.reserve(static_cast<std::size_t>(count));
  double number_before = 0, mass_before = 0;  // of the classes passed
  double mass_at_last_edge = 0;
  std::size_t c = 0;
  for (int i = 1; i <= count; ++i) {
    const double edge = stratum * i;
    while (c + 1 < classes.size() && number_before + classes[c].number() < edge) {
      number_before += classes[c].number();
      mass_before += classes[c].mass();
      ++c;
    }
    const double into_class = std::clamp(edge - number_before, 0.0, classes[c].number());
    const double mass_at_edge = mass_before + classes[c].mass_of_smallest(into_class);
    const double size = std::cbrt((mass_at_edge - mass_at_last_edge) / stratum);
    sizes.push_back(std::clamp(size, distribution.size.front(), distribution.size.back()));
    mass_at_last_edge = mass_at_edge;
  }
  return sizes;
}

RealisedSizes realised_sizes(const std::vector<double>& sizes, const std::vector<double>& masses) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  RealisedSizes sample;
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  double mass = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    mass += masses[order[rank]];
    sample.size.push_back(sizes[order[rank]]);
    sample.passing_mass.push_back(mass / total);
    sample.passing_number.push_back(double(rank + 1) / double(order.size()));
  }
  return sample;
}

double passing(const RealisedSizes& sample, double size, SizeBasis basis) {
  const auto& cumulative = basis == SizeBasis::mass ? sample.passing_mass : sample.passing_number;
  // A sieve opening that equals the particle's size within rounding lets it through.
  const double opening = size * (1 + 1e-12);
  const auto above = std::upper_bound(sample.size.begin(), sample.size.end(), opening);
  return above == sample.size.begin() ? 0 : cumulative[static_cast<std::size_t>(above - sample.size.begin()) - 1];
}

double size_at(const RealisedSizes& sample, double share, SizeBasis basis) {
  const auto& cumulative = basis == SizeBasis::mass ? sample.passing_mass : sample.passing_number;
  double last_middle = 0, before = 0;
  for (std::size_t i = 0; i < sample.size.size(); ++i) {
    const double middle = (before + cumulative[i]) / 2;
    if (share <= middle) {
      if (i == 0) return sample.size[0];
      return sample.size[i - 1] +
             (share - last_middle) / (middle - last_middle) * (sample.size[i] - sample.size[i - 1]);
    }
    last_middle = middle;
    before = cumulative[i];
  }
  return sample.size.empty() ? 0 : sample.size.back();
}

std::vector<double> report_sizes(const SizeDistribution& distribution) {
  if (distribution.size.size() <= kShortTable) {
    std::vector<double> sizes = distribution.size;
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    return sizes;
  }
  std::vector<double> sizes{distribution.size.front()};
  for (int i = 1; i <= kReportedShares; ++i) {
    const auto node =
        std::lower_bound(distribution.passing.begin(), distribution.passing.end(), double(i) / kReportedShares - 1e-12);
    const auto index =
        std::min(static_cast<std::size_t>(node - distribution.passing.begin()), distribution.size.size() - 1);
    if (distribution.size[index] > sizes.back()) sizes.push_back(distribution.size[index]);
  }
  return sizes;
}

}  // namespace workflows
