// SPDX-License-Identifier: Apache-2.0
#include "postprocess/vtk_export.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <fstream>
#include <stdexcept>

#include "postprocess/contact_statistics.h"
#include "postprocess/surfaces/vtk_surface.h"

namespace postprocess {
namespace {

using dem_gpu::RunGeometry;
using dem_gpu::Snapshot;
using dem_gpu::Vec3;

// Icosphere of 320 triangles: its volume is 3.4 % short of the sphere's.
constexpr int kSphereLevels = 2;

/// Cell array of VTK type `Array` that fill() fills value by value.
template <class Array>
class CellColumn {
 public:
  CellColumn(vtkPolyData* mesh, const char* name, int components = 1) {
    array_->SetName(name);
    array_->SetNumberOfComponents(components);
    mesh->GetCellData()->AddArray(array_);
  }
  void push(double value) { array_->InsertNextValue(static_cast<typename Array::ValueType>(value)); }
  void push(double value, int times) {
    for (int i = 0; i < times; ++i) push(value);
  }
  void push(const Vec3& v) {
    push(v.x);
    push(v.y);
    push(v.z);
  }

 private:
  vtkNew<Array> array_;
};

void write_vtp(const std::filesystem::path& file, vtkPolyData* mesh, double time) {
  vtkNew<vtkDoubleArray> time_value;
  time_value->SetName("TimeValue");
  time_value->InsertNextValue(time);
  mesh->GetFieldData()->AddArray(time_value);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(mesh);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetIdTypeToInt32();
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1) throw std::runtime_error(file.string() + ": VTK could not make the file");
  write_text_file(file, writer->GetOutputString());
}

}  // namespace

void write_bodies_vtp(const std::filesystem::path& file, const RunGeometry& geometry, const Snapshot& snapshot) {
  check_same_run(geometry, snapshot);
  std::vector<Surface> shapes;
  for (const dem_gpu::ShapeGeometry& shape : geometry.shapes) shapes.push_back(shape_surface(shape, kSphereLevels));
  Surface surface;
  std::vector<int> polygons_of(geometry.body_shape.size(), 0);
  for (std::size_t b = 0; b < geometry.body_shape.size(); ++b) {
    if (!snapshot.active[b]) continue;
    const auto [begin, end] =
        append(surface, shapes[geometry.body_shape[b]], body_placement(geometry, snapshot, static_cast<int>(b)));
    polygons_of[b] = end - begin;
  }
  vtkNew<vtkPolyData> mesh;
  set_surface(mesh, surface);
  CellColumn<vtkIntArray> body_id(mesh, "body_id"), shape_id(mesh, "shape_id"), material_id(mesh, "material_id");
  CellColumn<vtkFloatArray> speed(mesh, "speed"), angular_speed(mesh, "angular_speed"), mass(mesh, "mass");
  for (std::size_t b = 0; b < polygons_of.size(); ++b) {
    body_id.push(static_cast<double>(b), polygons_of[b]);
    shape_id.push(geometry.body_shape[b], polygons_of[b]);
    material_id.push(geometry.body_material[b], polygons_of[b]);
    speed.push(norm(snapshot.velocity[b]), polygons_of[b]);
    angular_speed.push(norm(snapshot.angular_velocity[b]), polygons_of[b]);
    mass.push(geometry.body_mass[b], polygons_of[b]);
  }
  mesh->GetCellData()->SetActiveScalars("speed");
  write_vtp(file, mesh, snapshot.time);
}

void write_walls_vtp(const std::filesystem::path& file, const RunGeometry& geometry, const Snapshot& snapshot) {
  check_same_run(geometry, snapshot);
  const Bounds bounds = scene_bounds(geometry, snapshot);
  Surface surface;
  std::vector<int> polygons_of(geometry.walls.size(), 0);
  for (std::size_t w = 0; w < geometry.walls.size(); ++w) {
    if (!snapshot.wall_present[w]) continue;
    const auto [begin, end] =
        append(surface, wall_surface(geometry.walls[w], bounds), wall_placement(snapshot, static_cast<int>(w)));
    polygons_of[w] = end - begin;
  }
  vtkNew<vtkPolyData> mesh;
  set_surface(mesh, surface);
  CellColumn<vtkIntArray> wall_id(mesh, "wall_id"), wall_kind(mesh, "wall_kind");
  for (std::size_t w = 0; w < polygons_of.size(); ++w) {
    wall_id.push(static_cast<double>(w), polygons_of[w]);
    wall_kind.push(static_cast<int>(geometry.walls[w].kind), polygons_of[w]);
  }
  write_vtp(file, mesh, snapshot.time);
}

void write_contacts_vtp(const std::filesystem::path& file, const RunGeometry& geometry, const Snapshot& snapshot) {
  check_same_run(geometry, snapshot);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  vtkNew<vtkCellArray> vertices, lines;
  const auto add_point = [&](const Vec3& p) { return points->InsertNextPoint(p.x, p.y, p.z); };
  for (const dem_gpu::SnapshotContact& contact : snapshot.contacts) {
    const vtkIdType point = add_point(contact.point);
    vertices->InsertNextCell(1, &point);
    std::vector<vtkIdType> chain{add_point(snapshot.position[contact.body_a]), point};
    if (contact.body_b >= 0) chain.push_back(add_point(snapshot.position[contact.body_b]));
    lines->InsertNextCell(static_cast<vtkIdType>(chain.size()), chain.data());
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetVerts(vertices);
  mesh->SetLines(lines);
  CellColumn<vtkFloatArray> force(mesh, "force", 3), magnitude(mesh, "force_magnitude"), overlap(mesh, "overlap");
  CellColumn<vtkIntArray> body_a(mesh, "body_a"), body_b(mesh, "body_b");
  for (int kind = 0; kind < 2; ++kind)  // VTK orders cell data by vertices first, then lines
    for (const dem_gpu::SnapshotContact& contact : snapshot.contacts) {
      force.push(contact.force);
      magnitude.push(norm(contact.force));
      overlap.push(contact.overlap);
      body_a.push(contact.body_a);
      body_b.push(contact.body_b);
    }
  mesh->GetCellData()->SetActiveScalars("force_magnitude");
  write_vtp(file, mesh, snapshot.time);
}

void write_pvd(const std::filesystem::path& file, const std::vector<SeriesEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const SeriesEntry& entry : entries) {
    char time[40];
    std::snprintf(time, sizeof time, "%.9g", entry.time);
    text += "    <DataSet timestep=\"" + std::string(time) + "\" group=\"\" part=\"0\" file=\"" + entry.file + "\"/>\n";
  }
  write_text_file(file, text + "  </Collection>\n</VTKFile>\n");
}

void write_text_file(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path temporary = file.string() + ".part";
  const auto fail = [&] {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(file.string() + ": cannot be written; is the disk full or the folder read-only?");
  };
  std::ofstream stream(temporary, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) fail();
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  if (error) fail();
}

}  // namespace postprocess
