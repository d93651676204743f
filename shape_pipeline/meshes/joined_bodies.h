// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/mesh_repair.h"
#include "shape_pipeline/meshes/surface_repair.h"

namespace shape_pipeline {

inline constexpr char kJoinedBodies[] = "repair_joined_bodies";  // the check that counts them after uniting

/// All surfaces of a mesh as one grain, see repair_mesh(). Specks, surfaces of less than a thousandth of the area, are
/// dropped. A surface that lies in another is a cavity if it is turned inwards, else it bounds nothing and is dropped;
/// any other is a body, turned outwards. Each is repaired by itself, as repair_mesh() would alone; bodies that cross
/// are united. `genus` is that of all bodies together. With the deviation.
RepairedMesh joined_bodies(CleanedScan scan, const RepairOptions& options);

}  // namespace shape_pipeline
