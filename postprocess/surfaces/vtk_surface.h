// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to postprocess/*.cpp files that use VTK.
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "postprocess/surfaces/surface.h"

namespace postprocess {

/// Points (32-bit) and polygons, no data.
vtkSmartPointer<vtkPolyData> poly_data(const Surface& surface);

}  // namespace postprocess
