// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/mesh_repair.h"
#include "shape_pipeline/meshes/surface_repair.h"

namespace shape_pipeline {

inline constexpr char kJoinedBodies[] = "repair_joined_bodies";  // the check that counts them after uniting

/// All surfaces of a mesh as one grain, or those of the largest body if options.bodies says so, see repair_mesh().
/// Specks, surfaces of less than a thousandth of the area and a hundredth together, are dropped; the others are bodies
/// and cavities by find_roles(). Each is repaired by itself; the solids of each body and its cavities are united.
/// `genus` is that of all surfaces together. With the deviation.
RepairedMesh joined_bodies(CleanedScan scan, const RepairOptions& options);

}  // namespace shape_pipeline
