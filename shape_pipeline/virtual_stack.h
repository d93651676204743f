// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/volumes/grey_volume.h"

namespace shape_pipeline {

struct StackRecipe {
  int grains = 20;
  double diameter = 20;  // volume-equivalent, of each grain [voxels]
  double blur = 0.8;     // standard deviation of the point spread [voxels]
  double noise = 10;     // standard deviation [grey values]
  double dark = 60, bright = 170;
  double voxel = 1e-5;  // [m]
  std::uint64_t seed = 1;
};

/// A tomogram of grains whose meshes are known.
struct VirtualStack {
  GreyVolume volume;                          // 8 bit
  std::vector<catalog::TriangleMesh> truths;  // in the frame of the stack [m]
};

/// The meshes, each scaled to the recipe's diameter and turned at random, heaped about a centre until they touch one
/// another, voxelised with partial volumes (exact along x, by four rays along y and z), blurred and noised. No grain
/// touches the border. The recipe's number of grains is drawn from the meshes in turn.
VirtualStack virtual_stack(const std::vector<catalog::TriangleMesh>& meshes, const StackRecipe& recipe);

/// Random rocks of the virtual scan, flat and long ones among them, every fourth with a notch, and a ball.
std::vector<catalog::TriangleMesh> stack_grains(int rocks, std::uint64_t seed);

}  // namespace shape_pipeline
