// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "catalog/shape_record.h"

namespace shape_pipeline {

struct SolidExpectation {
  int genus = 0;                          // of all surfaces together
  int surfaces = 1;                       // separate ones
  double second_volume = 0;               // [m3], by a method that needs no closed surface; 0 if there is none
  double second_volume_tolerance = 0.05;  // largest relative difference
  double least_hull_ratio = 0.5;          // V / V_hull below this: the surface has folded inwards
};

/// Whether a mesh bounds one right solid: "closed", "one_component", "euler_number", "positive_volume",
/// "volume_hull_ratio", "volume_second_method". A small distance to the scan proves none of these.
std::vector<catalog::Check> solid_checks(const catalog::TriangleMesh& mesh, const SolidExpectation& expectation);

bool all_passed(const std::vector<catalog::Check>& checks);

/// "closed: 12 open edges; euler_number: -4, expected 2": the checks that did not pass, or empty.
std::string failures(const std::vector<catalog::Check>& checks);

}  // namespace shape_pipeline
