// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "dem_gpu/scene.h"

namespace benchmark_scenes {

/// In [low, high). Drawn from the bits themselves, so that every standard library gives the same scene.
double uniform(std::mt19937_64& random, double low, double high);

/// Uniform over rotations. Shoemake, Graphics Gems III (1992) 124-132.
dem_gpu::Quaternion random_rotation(std::mt19937_64& random);

/// Turn by up to `largest_angle` [rad] about a random axis.
dem_gpu::Quaternion random_tilt(std::mt19937_64& random, double largest_angle);

/// Largest distance of a point of the shape from its centre, at scale 1 [m].
double bounding_radius(const dem_gpu::Shape& shape);

/// Where bodies begin: a lattice from `low` upwards in a box, one a cell, so that none overlap.
struct Lattice {
  dem_gpu::Vec3 low;  // lower corner of the box [m]
  double width = 0;   // of the box along x [m]
  double depth = 0;   // along y [m]
  double reach = 0;   // largest distance of a point of a body from its centre [m]
  double jitter = 0;  // largest shift of a site along each axis [m]
  /// Whether a site may be used; all where empty.
  std::function<bool(const dem_gpu::Vec3&)> is_free{};
};

/// The first `count` free sites, layer by layer from below, jittered [m].
/// Throws catalog::InputError if the box is too narrow for one body, or a thousand layers on end have no free site.
std::vector<dem_gpu::Vec3> lattice_sites(const Lattice& lattice, int count, std::mt19937_64& random);

}  // namespace benchmark_scenes
