// SPDX-License-Identifier: Apache-2.0
#include "workflows/size_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace workflows {
namespace {

const SizeDistribution kSieves{SizeBasis::mass, {2e-3, 4e-3, 8e-3, 16e-3}, {0, 0.35, 0.8, 1}};

std::vector<double> cubes(const std::vector<double>& sizes) {
  std::vector<double> masses;
  for (const double size : sizes) masses.push_back(size * size * size);
  return masses;
}

/// Normal cumulative distribution.
double normal_share(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Integral of f over [a, b] by Simpson's rule.
template <class Function>
double integral(const Function& f, double a, double b, int intervals = 2000) {
  const double h = (b - a) / intervals;
  double sum = f(a) + f(b);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 ? 4 : 2) * f(a + i * h);
  return sum * h / 3;
}

TEST(SizeDistribution, MassSharesOfASampleFollowTheTableToOneParticle) {
  for (const int count : {50, 420, 5000}) {
    const std::vector<double> sizes = sample_sizes(kSieves, count);
    ASSERT_EQ(sizes.size(), static_cast<std::size_t>(count));
    const std::vector<double> masses = cubes(sizes);
    const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
    const double largest_share = *std::max_element(masses.begin(), masses.end()) / total;
    const RealisedSizes sample = realised_sizes(sizes, masses);
    for (std::size_t i = 0; i < kSieves.size.size(); ++i)
      EXPECT_NEAR(passing(sample, kSieves.size[i], SizeBasis::mass), kSieves.passing[i], largest_share)
          << count << " sizes, sieve " << kSieves.size[i];
  }
}

TEST(SizeDistribution, SampledMassIsTheDistributionsMeanMass) {
  for (const int count : {1, 7, 300}) {
    const std::vector<double> masses = cubes(sample_sizes(kSieves, count));
    const double mean = std::accumulate(masses.begin(), masses.end(), 0.0) / count;
    EXPECT_NEAR(mean, mean_cubed_size(kSieves), 1e-9 * mean);
  }
}

TEST(SizeDistribution, NumberOfAMassTableFollowsFromInverseCubes) {
  // Mass density f on a class; number density f / d^3.
  const auto mass_density = [](double size) {
    return size < 4e-3 ? 0.35 / 2e-3 : size < 8e-3 ? 0.45 / 4e-3 : 0.2 / 8e-3;
  };
  const auto number_density = [&](double size) { return mass_density(size) / (size * size * size); };
  const double below = integral(number_density, 2e-3, 4e-3 - 1e-15),
               middle = integral(number_density, 4e-3, 8e-3 - 1e-15), above = integral(number_density, 8e-3, 16e-3);
  EXPECT_NEAR(passing(kSieves, 4e-3, SizeBasis::number), below / (below + middle + above), 1e-7);
  EXPECT_NEAR(passing(kSieves, 8e-3, SizeBasis::number), (below + middle) / (below + middle + above), 1e-7);
  EXPECT_NEAR(mean_cubed_size(kSieves), 1 / (below + middle + above), 1e-6 * mean_cubed_size(kSieves));
}

TEST(SizeDistribution, NumberSharesOfASampleFollowANumberTable) {
  SizeDistribution by_number = kSieves;
  by_number.basis = SizeBasis::number;
  const std::vector<double> sizes = sample_sizes(by_number, 400);
  const RealisedSizes sample = realised_sizes(sizes, cubes(sizes));
  for (std::size_t i = 0; i < by_number.size.size(); ++i)
    EXPECT_NEAR(passing(sample, by_number.size[i], SizeBasis::number), by_number.passing[i], 1.0 / 400);
}

TEST(SizeDistribution, LognormalByMassIsLognormalByNumberWithItsMedianShifted) {
  // Hatch & Choate, J. Franklin Inst. 207 (1929) 369: ln d50_number = ln d50_mass - 3 ln^2 sigma_g.
  const double d50 = 5e-3, sigma = 1.4, log_sigma = std::log(sigma);
  const SizeDistribution distribution = lognormal(SizeBasis::mass, d50, sigma, d50 / 10, d50 * 10);
  const double number_median = d50 * std::exp(-3 * log_sigma * log_sigma);
  for (const double z : {-2.0, -1.0, 0.0, 0.5, 1.5}) {
    EXPECT_NEAR(passing(distribution, d50 * std::exp(z * log_sigma), SizeBasis::mass), normal_share(z), 1e-5);
    EXPECT_NEAR(passing(distribution, number_median * std::exp(z * log_sigma), SizeBasis::number), normal_share(z),
                1e-4);
  }
}

TEST(SizeDistribution, RosinRammlerPassesItsClosedFormBetweenTheCuts) {
  const double d63 = 10e-3, spread = 2.5, least = 1e-3, most = 30e-3;
  const SizeDistribution distribution = rosin_rammler(SizeBasis::mass, d63, spread, least, most);
  const auto closed = [&](double size) { return 1 - std::exp(-std::pow(size / d63, spread)); };
  for (const double size : {2e-3, 5e-3, 10e-3, 20e-3})
    EXPECT_NEAR(passing(distribution, size, SizeBasis::mass),
                (closed(size) - closed(least)) / (closed(most) - closed(least)), 1e-5);
  EXPECT_EQ(passing(distribution, least, SizeBasis::mass), 0);
  EXPECT_NEAR(passing(distribution, most, SizeBasis::mass), 1, 1e-15);
}

TEST(SizeDistribution, SampleOfACurveFollowsIt) {
  const SizeDistribution distribution = rosin_rammler(SizeBasis::mass, 10e-3, 3, 4e-3, 20e-3);
  const std::vector<double> sizes = sample_sizes(distribution, 1000);
  EXPECT_TRUE(std::is_sorted(sizes.begin(), sizes.end()));
  const RealisedSizes sample = realised_sizes(sizes, cubes(sizes));
  for (const double size : report_sizes(distribution))
    EXPECT_NEAR(passing(sample, size, SizeBasis::mass), passing(distribution, size, SizeBasis::mass), 0.01);
}

TEST(SizeDistribution, SingleSizeGivesThatSize) {
  for (const double size : sample_sizes(single_size(3e-3), 9)) EXPECT_NEAR(size, 3e-3, 1e-15);
}

TEST(SizeDistribution, CharacteristicSizesOfAKnownSample) {
  // Masses 1, 1, 2: the middles stand at 1/8, 3/8, 3/4 of the mass.
  const RealisedSizes sample = realised_sizes({3, 1, 2}, {2, 1, 1});
  EXPECT_DOUBLE_EQ(size_at(sample, 0.125, SizeBasis::mass), 1);
  EXPECT_DOUBLE_EQ(size_at(sample, 0.25, SizeBasis::mass), 1.5);
  EXPECT_DOUBLE_EQ(size_at(sample, 0.75, SizeBasis::mass), 3);
  EXPECT_DOUBLE_EQ(size_at(sample, 0.5, SizeBasis::number), 2);
  EXPECT_DOUBLE_EQ(passing(sample, 2, SizeBasis::mass), 0.5);
}

}  // namespace
}  // namespace workflows
