// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/micrographs/raster.h"

namespace shape_pipeline {

/// What stands out less far is the rough edge of a grain [pixels].
inline constexpr double kLeastPatch = 4.8;

/// A first parting of the grains of a mask, finer than the grains are: a flood of the distance to the outside from its
/// peaks down (Meyer & Beucher 1990), in which two basins become one where the saddle between them is hardly narrower
/// than the lower peak (above 97 % of it, or less than half a pixel below); then caps, which stand out of a basin and
/// have no peak of their own, since what they belong to lies behind: where the largest disc about a pixel inside the
/// basin has less than half the radius of the basin's largest, and the cap is wider than kLeastPatch. Labels 1 to
/// count.
LabelImage distance_basins(const Mask& mask);

/// Each connected patch of the marked pixels within one label, if it is wider than `width` pixels somewhere, becomes a
/// region of its own, with labels after those there are.
void part_patches(LabelImage& labels, Mask marked, double width);

/// Largest label of an image.
int label_count(const LabelImage& labels);

/// The labels made to run from 1 to their number, in the order of their first pixels; 0 stays.
void number_labels(LabelImage& labels);

}  // namespace shape_pipeline
