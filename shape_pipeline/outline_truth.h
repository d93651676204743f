// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shape_pipeline/micrograph.h"

namespace shape_pipeline {

/// Hand outlines of one image from a project file of the VGG Image Annotator, version 2 (Dutta & Zisserman 2019), in
/// pixels as there. `image` is the file name that the project states. Throws InputError, the file named, for what is no
/// such project, has no such image or an outline of fewer than three corners.
std::vector<Outline> read_hand_outlines(const std::filesystem::path& path, const std::string& image);

/// How outlines agree with true ones.
struct OutlineScore {
  std::size_t found = 0, real = 0, matched = 0;  // a match: intersection over union of at least 0.5, one to one
  double precision = 0, recall = 0, f1 = 0;      // matched / found, matched / real, their harmonic mean [-]
  double median_found = 0, median_real = 0;      // area-equivalent diameters of whole grains [pixels]

  double median_error() const { return median_found / median_real - 1; }  // [-]
};

/// All outlines of a micrograph, those at the border among them, against the truth; pairs are taken from the best
/// agreement down. Pixels count by their centres. True outlines within a pixel of the border are no whole grains.
OutlineScore score_outlines(const Micrograph& micrograph, const std::vector<Outline>& truth);

}  // namespace shape_pipeline
