// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/surface_map.h"

#include <fstream>

#include "catalog/input_error.h"
#include "workflows/text_format.h"

namespace workflows {

void write_surface_map(const std::filesystem::path& path, const catalog::TriangleMesh& mesh, const std::string& name,
                       const std::vector<double>& values) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\">\n<PolyData>\n";
  text += formatted("<Piece NumberOfPoints=\"%zu\" NumberOfPolys=\"%zu\">\n", mesh.vertices.size(), mesh.faces.size());
  text += "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const auto& [x, y, z] : mesh.vertices) text += formatted("%.9g %.9g %.9g\n", x, y, z);
  text += "</DataArray></Points>\n<PointData Scalars=\"" + name + "\"><DataArray type=\"Float64\" Name=\"" + name +
          "\" format=\"ascii\">\n";
  for (const double value : values) text += formatted("%.9g\n", value);
  text += "</DataArray></PointData>\n<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& [a, b, c] : mesh.faces) text += formatted("%d %d %d\n", a, b, c);
  text += "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t f = 1; f <= mesh.faces.size(); ++f) text += formatted("%zu\n", 3 * f);
  text += "</DataArray></Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  if (!stream.flush())
    throw catalog::InputError(path.string() + ": cannot be written; check the folder and the space on the disk");
}

}  // namespace workflows
