// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "postprocess/surfaces/surface.h"

class vtkPolyData;

namespace postprocess {

/// Gives an empty `mesh` the surface's points (32-bit) and polygons.
void set_surface(vtkPolyData* mesh, const Surface& surface);

}  // namespace postprocess
