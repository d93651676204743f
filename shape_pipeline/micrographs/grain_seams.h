// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "shape_pipeline/micrographs/grain_mask.h"
#include "shape_pipeline/micrographs/raster.h"

namespace shape_pipeline {

/// Where two regions of a label image touch.
struct Seam {
  int first = 0, second = 0;  // labels
  double neck = 0;            // half the seam's length / radius of the smaller region's largest disc
  double contrast = 0;        // |grey of one side - other side| / their sum, above the background, within 4 pixels
  double size_ratio = 0;      // root of smaller area / larger area
  double solidity = 0;        // area of both / that of the hull about both
};

/// The regions flooded anew from their cores along the gradient of grey values (watershed, Meyer & Beucher 1990), so
/// that the seams lie on the edges which the image shows.
LabelImage with_seams_on_edges(const LabelImage& regions, const Mask& mask, const GreyImage& gradient);

/// All seams, in the order of their labels.
std::vector<Seam> measured_seams(const LabelImage& regions, const GreyImage& grey, double background);

/// Whether the two sides of a seam are one grain: no edge of grey values between them, a wide neck, and no dent where
/// two of about one size meet.
bool is_one_grain(const Seam& seam);

/// Grey of each region, by label: the lower quartile of its pixels that lie more than two pixels inside, which the blur
/// of the edge does not reach; of all where there are none. 0 for the background.
std::vector<double> region_greys(const LabelImage& regions, const GreyImage& grey);

/// The grains of a mask apart from one another, labels 1 to their number. Parts of a region below half its grey (above
/// the background), where its outline could not run, are grains in the shade behind it. Neither flood nor rule knows
/// circles: grains may have any shape.
LabelImage separated_grains(const GreyImage& grey, const Mask& mask, const GreyLevels& levels);

/// Radius of the largest disc inside each region, by label [pixels]; seams count as outside.
std::vector<double> region_radii(const LabelImage& regions);

}  // namespace shape_pipeline
