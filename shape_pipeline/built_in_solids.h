// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

struct SolidParameter {
  std::string name;
  double usual, least, most;  // what is taken if not given; allowed range, ends included
  std::string meaning;
};

struct SolidKind {
  std::string name, meaning;
  std::vector<SolidParameter> parameters;
};

/// The solids that can be made from nothing: the Platonic ones, truncated tetrahedron, bilunabirotunda (J91),
/// hexagonal prism, dice, L, cross, ring, hexapod, superquadric, crushed rock.
const std::vector<SolidKind>& built_in_solids();

struct SolidRecipe {
  std::string solid;                         // name of a SolidKind
  std::map<std::string, double> parameters;  // those given; the others take what is usual
  std::uint64_t seed = 1;                    // of the crushed rock
};

struct BuiltSolid {
  catalog::TriangleMesh mesh;  // closed, outward, of a size of about 1
  int genus = 0;
  std::optional<double> exact_volume;  // of the solid meant, by closed form, in the mesh's units
  double volume_tolerance = 0;         // relative; what a mesh inscribed in a curved solid lacks at most
};

/// Throws InputError for an unknown solid or parameter (naming the nearest known one) or a value out of its range.
BuiltSolid built_in_solid(const SolidRecipe& recipe);

/// The recipe with every parameter that its solid has, checked as above.
SolidRecipe complete_recipe(const SolidRecipe& recipe);

}  // namespace shape_pipeline
