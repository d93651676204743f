// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "catalog/separate_bodies.h"
#include "catalog/shape_record.h"

namespace shape_pipeline {

/// When an alpha wrap replaces the mesh.
enum class Wrapping { never, where_repair_fails, always };

struct RepairOptions {
  int genus = 0;  // handles of the particle: 0 for a stone, 1 for a ring
  Wrapping wrapping = Wrapping::where_repair_fails;
  // refuse: the largest surface must have 90 % of the area, the others are specks and dropped; else closed surfaces
  // must meet and so be one body without a cavity, and torn patches are taken for one surface. largest: the body of
  // largest area with its cavities. join: all are one grain.
  catalog::SeparateBodies bodies = catalog::SeparateBodies::refuse;
};

/// A closed, outward mesh of one solid (of several if bodies are joined), or the reason why there is none.
struct RepairedMesh {
  catalog::TriangleMesh mesh;          // empty if refused
  std::vector<catalog::Check> checks;  // each repair with its count, the checks of the solid, "deviation_mean",
                                       // "deviation_95", "deviation_largest": of the input from it / diagonal
  std::string refusal;                 // one line; empty if the mesh may be used
  std::string remedy;                  // of the refusal, where it has one of its own
};

/// Welds vertices, removes degenerate and double faces, orients, splits forked edges, keeps the largest surface, fills
/// holes, removes self-intersections, turns outwards; checks the result and, where that is no right solid, rebuilds it
/// from its points or wraps it. Of several bodies so for each, see meshes/joined_bodies.h; where that cannot be done
/// and the largest surface has 90 % of the area, that alone is taken, and the check "repair_joined_bodies" fails.
RepairedMesh repair_mesh(const catalog::TriangleMesh& scanned, const RepairOptions& options);

}  // namespace shape_pipeline
