// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/outline_descriptors.h"

namespace shape_pipeline {

struct PopulationOptions {
  int count = 20;
  std::uint64_t seed = 1;
  double third_axis = 0;  // S/I of every grain, in (0, 1]; 0: drawn like I/L, independently of it
};

/// Mean and standard deviation over the outlines and over the silhouettes of the made grains.
struct FormComparison {
  std::string name;  // of the figure
  double measured_mean = 0, measured_spread = 0, made_mean = 0, made_spread = 0;

  /// Whether the means agree within 2 %, of ratios 0.005 more, and three standard errors of `count` grains.
  bool agrees(int count) const;
};

struct MatchedPopulation {
  std::vector<catalog::TriangleMesh> grains;  // from the smallest up; star-shaped, closed, outward [m]
  std::vector<FormComparison> comparison;     // equivalent diameter [m], aspect ratio, roughness, solidity, circularity
  double ratio_power = 1;                     // I/L = (seen aspect ratio) to this power
  double roughness_factor = 1;                // of the surface over that seen in the outlines
  std::string assumption;                     // what was taken for the axis that no outline shows, in words
};

/// A population of solids whose silhouettes in random orientation look like the outlines (in metres). An outline does
/// not show its third axis, so one must be assumed. Each grain takes size, aspect ratio m and roughness of one outline,
/// drawn by systematic sampling over the sizes (outlines below 20 pixels give their size alone, any other the rest),
/// and is an ellipsoid of I/L = m^p whose radii are changed by a random field of plane waves over the unit sphere,
/// their wave numbers 3 to 12 drawn by the mean power spectrum of the outlines' deviation from their ellipses: the
/// low-passed outline. p and the field's amplitude are found by halving on 48 other grains, so that the silhouettes'
/// mean aspect ratio and mean roughness (root mean square deviation from the ellipse over the radius, wave numbers 3 to
/// 12) are those of the outlines; spreads, solidity and circularity are not fitted, only compared. The outlines are
/// taken for whole silhouettes, each grain for as likely to be seen as any. Throws InputError for fewer than 10
/// outlines of 20 pixels.
MatchedPopulation matched_population(const std::vector<Outline>& outlines, double pixel,
                                     const PopulationOptions& options);

}  // namespace shape_pipeline
