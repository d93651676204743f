// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace workflows {

/// What the shares of a distribution count.
enum class SizeBasis { mass, number };

/// Which length of a particle is its size.
enum class SizeDefinition {
  sieve,              // second edge of the oriented bounding box: the width that decides which mesh it passes
  volume_equivalent,  // diameter of the sphere of the same volume
  max_feret,          // largest distance between two points
};

const char* name_of(SizeBasis basis);
const char* name_of(SizeDefinition definition);

/// Cumulative share passing, linear in size between nodes. A class of zero width is a single size.
struct SizeDistribution {
  SizeBasis basis = SizeBasis::mass;
  std::vector<double> size;     // n_nodes, ascending, the first > 0 [m]
  std::vector<double> passing;  // n_nodes, ascending from 0 to 1 [-]
};

SizeDistribution single_size(double size);
/// P = 1 - exp(-(size / d63)^spread), cut to [least, most] and scaled to 0..1. Rosin & Rammler, J. Inst. Fuel 7 (1933).
SizeDistribution rosin_rammler(SizeBasis basis, double d63, double spread, double least, double most);
/// Lognormal with median d50 and geometric standard deviation > 1, cut to [least, most] and scaled to 0..1.
SizeDistribution lognormal(SizeBasis basis, double d50, double geometric_deviation, double least, double most);

/// Share passing `size`, counted on either basis for particles of one shape and density (mass ~ size^3).
double passing(const SizeDistribution& distribution, double size, SizeBasis basis);

/// Mean of size^3 over the number of particles [m3].
double mean_cubed_size(const SizeDistribution& distribution);

/// `count` sizes, ascending, without chance: the distribution is cut into `count` strata of equal number, and each
/// stratum stands for itself by the size of its mean mass. So the mass below each stratum's edge is exact, and no share
/// by mass is further off than one particle.
std::vector<double> sample_sizes(const SizeDistribution& distribution, int count);

/// A sample as it came out.
struct RealisedSizes {
  std::vector<double> size;            // n sorted ascending [m]
  std::vector<double> passing_mass;    // n cumulative share up to and including the particle
  std::vector<double> passing_number;  // n
};
RealisedSizes realised_sizes(const std::vector<double>& sizes, const std::vector<double>& masses);

/// Share of the sample that is not larger than `size`.
double passing(const RealisedSizes& sample, double size, SizeBasis basis);

/// Size that the share passes: linear between the particles, each counted in at its middle.
double size_at(const RealisedSizes& sample, double share, SizeBasis basis);

/// Sizes at which to compare the two: the nodes of a short table, else sizes at even shares.
std::vector<double> report_sizes(const SizeDistribution& distribution);

}  // namespace workflows
