// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "catalog/shape_record.h"
#include "shape_pipeline/mesh_remeshing.h"
#include "shape_pipeline/stack_sources.h"
#include "shape_pipeline/volumes/grey_volume.h"

namespace shape_pipeline {

enum class StackDenoising { gaussian, median, none };

struct StackOptions {
  std::optional<std::array<double, 3>> voxel_size;  // [m]; needed where the file states none
  StackDenoising denoising = StackDenoising::gaussian;
  double gaussian_sigma = 0.5;      // [voxels]: halves white noise and moves hardly any surface
  std::optional<double> threshold;  // in grey values of the file; else found from them
  double neck_ratio = 0.7;          // neck / thinner neighbour, above which two peaks are one grain
  double least_diameter = 10;       // voxels a volume-equivalent diameter; grains below are refused
  bool keeps_cavities = false;      // as inner surfaces; else they are filled
  double memory_limit = 0;          // [bytes]; 0: nine tenths of the machine's memory
  RemeshingOptions remeshing;
};

struct StackGrain {
  catalog::ShapeRecord shape;  // name and provenance are left to the caller
  catalog::Point centre{};     // of mass, in the frame of the stack: first voxel's centre at the origin [m]
  double diameter = 0;         // volume-equivalent [voxels]
  std::string refusal;         // why it is no shape; empty if it is one
};

struct StackSummary {
  std::array<double, 3> voxel_size{};  // [m]
  double threshold = 0;                // in grey values of the file
  std::size_t grains = 0;              // handed over, those refused among them
  std::size_t refused = 0;
  std::size_t at_border = 0;  // cut by the border and dropped
  std::size_t specks = 0;     // below 4 voxels a diameter: noise, dropped
};

/// From a tomogram to its grains, the largest first: read, denoised, parted where grains touch, each with a surface
/// below the size of a voxel, checked and described. Bright is grain. Needs the grey values and about 5 bytes a voxel
/// more. Throws InputError, the file named, for what cannot be read, is constant, or holds no whole grain.
StackSummary digitize_stack(const std::filesystem::path& path, const StackOptions& options,
                            const std::function<void(StackGrain&&)>& take);

/// The same of a tomogram in memory, which messages call `name`.
StackSummary digitize_stack(GreyVolume volume, const std::string& name, const StackOptions& options,
                            const std::function<void(StackGrain&&)>& take);

}  // namespace shape_pipeline
