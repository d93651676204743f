// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "catalog/shape_record.h"

namespace shape_pipeline {

/// When an alpha wrap replaces the mesh.
enum class Wrapping { never, where_repair_fails, always };

struct RepairOptions {
  int genus = 0;  // handles of the particle: 0 for a stone, 1 for a ring
  Wrapping wrapping = Wrapping::where_repair_fails;
};

/// A closed, outward mesh of one solid, or the reason why there is none.
struct RepairedMesh {
  catalog::TriangleMesh mesh;          // empty if refused
  std::vector<catalog::Check> checks;  // each repair with its count, the checks of the solid, "deviation_mean",
                                       // "deviation_95", "deviation_largest": of the input from it / diagonal
  std::string refusal;                 // one line; empty if the mesh may be used
};

/// Welds vertices, removes degenerate and double faces, orients, splits forked edges, keeps the largest surface, fills
/// holes, removes self-intersections, turns outwards; checks the result and, where that is no right solid, wraps it.
RepairedMesh repair_mesh(const catalog::TriangleMesh& scanned, const RepairOptions& options);

}  // namespace shape_pipeline
