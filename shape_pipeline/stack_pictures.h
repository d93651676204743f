// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "shape_pipeline/ct_stack.h"
#include "shape_pipeline/grain_pictures.h"

namespace shape_pipeline {

/// A grain of a stack for drawing: its surface in the frame of the stack.
struct ColouredGrain {
  catalog::TriangleMesh mesh;  // first voxel's centre at the origin [m]
  Colour colour{};
};

/// Part of a plane of voxels: across x (0), y (1) or z (2).
struct StackSection {
  int axis = 2;
  catalog::Point centre{};  // in the middle of the picture [m]
  double half_width = 0;    // of a square part [m]; 0: the whole plane
  int side = 480;           // longest of the picture [pixels]
};

/// A stack, denoised as it was for its grains, to look at its grains in it.
class StackPictures {
 public:
  /// Throws InputError as digitize_stack does for what cannot be read.
  StackPictures(const std::filesystem::path& stack, const StackOptions& options);

  catalog::Point middle() const;

  /// Grey voxels with what the grains' surfaces enclose tinted and outlined, each in its colour.
  ColourImage section(const StackSection& section, const std::vector<ColouredGrain>& grains) const;

  /// Distance of each vertex along the surface's normal from where the grey value passes `threshold` (in values of the
  /// file), positive outside; none beyond two voxels: seams between grains that touch.
  DeviationMap deviation(const catalog::TriangleMesh& grain, double threshold) const;

 private:
  double grey(const catalog::Point& place) const;  // between voxels linear, beyond the border the outermost voxel's

  GreyVolume volume_;
  double dark_ = 0, bright_ = 255;  // of the pictures
};

}  // namespace shape_pipeline
