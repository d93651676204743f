// SPDX-License-Identifier: Apache-2.0
#include "postprocess/surfaces/vtk_surface.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace postprocess {

void set_surface(vtkPolyData* mesh, const Surface& surface) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(static_cast<vtkIdType>(surface.points.size()));
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), surface.points[i].x, surface.points[i].y, surface.points[i].z);
  vtkNew<vtkCellArray> polygons;
  for (int p = 0; p < surface.polygon_count(); ++p) {
    const int begin = surface.polygon_begin(p), end = surface.polygon_end[p];
    polygons->InsertNextCell(end - begin);
    for (int c = begin; c < end; ++c) polygons->InsertCellPoint(surface.corners[c]);
  }
  mesh->SetPoints(points);
  mesh->SetPolys(polygons);
}

}  // namespace postprocess
