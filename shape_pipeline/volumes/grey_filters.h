// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/volumes/grey_volume.h"

namespace shape_pipeline {

/// Each voxel the median of the 27 about it; the outermost layer is repeated beyond the border. In place, with three
/// slices beside the volume.
void median_filter(GreyVolume& volume);

/// Convolved with a Gaussian of this standard deviation [voxels], cut at three of them; in place, with a few slices
/// beside the volume. It moves a surface of mean curvature H inwards by sigma^2 H.
void gaussian_filter(GreyVolume& volume, double sigma);

/// What a threshold parts.
struct GreyClasses {
  double threshold = 0;     // in values of the volume: at or above it is grain
  double dark = 0;          // mean below
  double bright = 0;        // mean at or above
  double separability = 0;  // variance between the classes / whole variance [-]; 0.64 for one Gaussian hump
};

/// Otsu 1979: the threshold of the largest variance between the classes, placed halfway between their means, which is
/// the fixed point of Ridler & Calvard 1978 beside it and no whole number. Separability 0 where all voxels are equal.
GreyClasses otsu_classes(const GreyVolume& volume);

/// Otsu's classes with their levels taken where the partial volumes of surfaces do not reach, as the medians of the
/// voxels three voxels deep on either side (two or one where there are hardly any), and the threshold at which the
/// grains have the volume that the grey values between those levels add up to. Halfway between the levels, as usual
/// ("ISO 50 %"), blur of standard deviation s would take 3 s^2 / R^2 of the volume of a grain of radius R.
GreyClasses plateau_classes(const GreyVolume& volume);

/// The classes of a given threshold.
GreyClasses classes_at(const GreyVolume& volume, double threshold);

}  // namespace shape_pipeline
