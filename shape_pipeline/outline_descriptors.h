// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

namespace shape_pipeline {

using PlanePoint = std::array<double, 2>;

/// Corners of a closed outline, in order, without repeating the first; x to the right, y down the image. Either sense.
using Outline = std::vector<PlanePoint>;

struct OutlineDescriptor {
  std::string name;
  std::string unit;  // "m", "m2", "deg", "-", where the outline is in metres
  double value = 0;  // not a number where the outline has none (see docs/descriptors.md)
};

/// Descriptors of one outline in metres, always the same ones in the same order: ImageJ's and those of ISO 9276-6,
/// sphericities, Wadell roundness. Names carry the formula; formulas and sources in docs/descriptors.md. `pixel`: side
/// of a pixel of the image the outline was taken from [m], below which corners are noise; 0 for a drawn one. Throws
/// InputError for outlines of fewer than three corners, with numbers that are none, or of no area.
std::vector<OutlineDescriptor> outline_descriptors(const Outline& outline, double pixel);

/// Of the names above; not a number if there is none of that name.
double descriptor_value(const std::vector<OutlineDescriptor>& descriptors, const std::string& name);

/// The few that are cheap, for many outlines.
struct OutlineForm {
  double equivalent_diameter = 0;  // of the circle of equal area, in the outline's unit
  double aspect_ratio = 0;         // minor / major axis of the ellipse of equal second moments [-]
  double solidity = 0;             // A / A_hull [-]
  double circularity = 0;          // 4 pi A / P^2 [-]
};
OutlineForm outline_form(const Outline& outline);

}  // namespace shape_pipeline
