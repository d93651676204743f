// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Several solids as one point set.
struct SolidUnion {
  catalog::TriangleMesh mesh;  // closed surfaces that do not cross
  std::size_t united = 0;      // solids that became one with another
  std::size_t touching = 0;    // pairs of faces in which solids share but an edge or a corner: left as they are
  std::string refusal;         // one line; empty if the mesh may be used
};

/// The points that lie in one of the solids, each bounded by closed surfaces (its cavities turned inwards). Solids that
/// meet are united one by one (exact predicates; new vertices are rounded), others are left as they are. Refused: a
/// cavity that crosses its own body, and what the union cannot make a closed surface of.
SolidUnion union_of_solids(const std::vector<catalog::TriangleMesh>& solids);

}  // namespace shape_pipeline
