// SPDX-License-Identifier: Apache-2.0
#include "postprocess/vtk_export.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <numbers>

#include "catalog/input_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/postprocess/synthetic_run.h"

namespace postprocess {
namespace {

using test_support::read_bytes;
using test_support::TemporaryFolder;

vtkSmartPointer<vtkPolyData> read(const std::filesystem::path& file) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST(BodiesVtp, HoldsEachActiveBodysFacesAndData) {
  const TemporaryFolder folder;
  const auto geometry = test_support::hopper_geometry();
  const auto snapshot = test_support::hopper_snapshot(geometry, 2.0);
  write_bodies_vtp(folder / "b.vtp", geometry, snapshot);
  const auto mesh = read(folder / "b.vtp");
  vtkIdType faces = 0, points = 0;
  for (std::size_t b = 0; b < geometry.body_shape.size(); ++b)
    for (const auto& part : geometry.shapes[geometry.body_shape[b]].parts) {
      faces += snapshot.active[b] ? static_cast<vtkIdType>(part.face_count()) : 0;
      points += snapshot.active[b] ? static_cast<vtkIdType>(part.vertex_count()) : 0;
    }
  EXPECT_EQ(mesh->GetNumberOfPolys(), faces);
  EXPECT_EQ(mesh->GetNumberOfPoints(), points);
  for (const char* name : {"body_id", "shape_id", "material_id", "speed", "angular_speed", "mass"}) {
    ASSERT_NE(mesh->GetCellData()->GetArray(name), nullptr) << name;
    EXPECT_EQ(mesh->GetCellData()->GetArray(name)->GetNumberOfTuples(), faces);
  }
  double lowest = 1e300;
  for (vtkIdType c = 0; c < faces; ++c) {
    const auto body = static_cast<std::size_t>(mesh->GetCellData()->GetArray("body_id")->GetTuple1(c));
    lowest = std::min(lowest, static_cast<double>(body));
    ASSERT_TRUE(snapshot.active[body]);
    ASSERT_FLOAT_EQ(static_cast<float>(mesh->GetCellData()->GetArray("speed")->GetTuple1(c)),
                    static_cast<float>(norm(snapshot.velocity[body])));
  }
  EXPECT_EQ(lowest, 40);  // 2 kg/s for 1 s in bodies of 0.05 kg have left
}

TEST(BodiesVtp, ASphereIsAClosedSphereOfItsSize) {
  const TemporaryFolder folder;
  dem_gpu::RunGeometry geometry = test_support::mill_geometry();
  auto snapshot = test_support::mill_snapshot(geometry, 0);
  for (std::size_t b = 1; b < snapshot.active.size(); ++b) snapshot.active[b] = 0;  // body 0 is a steel ball
  write_bodies_vtp(folder / "b.vtp", geometry, snapshot);
  vtkNew<vtkMassProperties> solid;
  solid->SetInputData(read(folder / "b.vtp"));
  const double volume = 4 * std::numbers::pi / 3 * std::pow(0.022, 3);
  EXPECT_LT(solid->GetVolume(), volume);
  EXPECT_GT(solid->GetVolume(), 0.96 * volume);
}

TEST(WallsVtp, CylinderHasItsAreaAndRemovedWallsAreGone) {
  const TemporaryFolder folder;
  dem_gpu::RunGeometry geometry = test_support::hopper_geometry();
  auto snapshot = test_support::hopper_snapshot(geometry, 0);
  snapshot.wall_present = {1, 0, 0};
  write_walls_vtp(folder / "w.vtp", geometry, snapshot);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(read(folder / "w.vtp"));
  vtkNew<vtkMassProperties> surface;
  surface->SetInputConnection(triangles->GetOutputPort());
  EXPECT_NEAR(surface->GetSurfaceArea() / (2 * std::numbers::pi * 0.2 * 0.4), 1, 1e-3);
}

TEST(WallsVtp, TurnWithTheSnapshot) {
  const TemporaryFolder folder;
  const auto geometry = test_support::mill_geometry();
  const auto snapshot = test_support::mill_snapshot(geometry, 1.0);
  write_walls_vtp(folder / "w.vtp", geometry, snapshot);
  const auto mesh = read(folder / "w.vtp");
  // The first corner of the last lifter, turned by 2.5 rad about +y.
  const auto& corner = geometry.walls.back().part.vertices.front();
  const double c = std::cos(2.5), s = std::sin(2.5);
  const double* point = mesh->GetPoint(mesh->GetNumberOfPoints() - 8);
  EXPECT_NEAR(point[0], c * corner[0] + s * corner[2], 1e-6);
  EXPECT_NEAR(point[1], corner[1], 1e-6);
  EXPECT_NEAR(point[2], -s * corner[0] + c * corner[2], 1e-6);
}

TEST(ContactsVtp, HasAPointAndALineForEachContact) {
  const TemporaryFolder folder;
  const auto geometry = test_support::hopper_geometry();
  const auto snapshot = test_support::hopper_snapshot(geometry, 0);
  write_contacts_vtp(folder / "c.vtp", geometry, snapshot);
  const auto mesh = read(folder / "c.vtp");
  const auto count = static_cast<vtkIdType>(snapshot.contacts.size());
  ASSERT_GT(count, 0);
  EXPECT_EQ(mesh->GetNumberOfVerts(), count);
  EXPECT_EQ(mesh->GetNumberOfLines(), count);
  vtkDataArray* force = mesh->GetCellData()->GetArray("force_magnitude");
  for (vtkIdType c = 0; c < 2 * count; ++c)
    ASSERT_FLOAT_EQ(static_cast<float>(force->GetTuple1(c)),
                    static_cast<float>(norm(snapshot.contacts[static_cast<std::size_t>(c % count)].force)));
}

TEST(VtpFiles, EqualSnapshotsGiveEqualBytesAndLeaveNothingBeside) {
  const TemporaryFolder folder;
  const auto geometry = test_support::mill_geometry();
  const auto snapshot = test_support::mill_snapshot(geometry, 1.0);
  for (const auto write : {write_bodies_vtp, write_walls_vtp, write_contacts_vtp}) {
    write(folder / "a.vtp", geometry, snapshot);
    write(folder / "b.vtp", geometry, snapshot);
    EXPECT_EQ(read_bytes(folder / "a.vtp"), read_bytes(folder / "b.vtp"));
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(VtpFiles, AnEmptySceneIsAFileTheReaderTakes) {
  const TemporaryFolder folder;
  const auto geometry = test_support::hopper_geometry();
  auto snapshot = test_support::hopper_snapshot(geometry, 0);
  std::fill(snapshot.active.begin(), snapshot.active.end(), 0);
  std::fill(snapshot.wall_present.begin(), snapshot.wall_present.end(), 0);
  snapshot.contacts.clear();
  for (const auto write : {write_bodies_vtp, write_walls_vtp, write_contacts_vtp}) {
    write(folder / "a.vtp", geometry, snapshot);
    EXPECT_EQ(read(folder / "a.vtp")->GetNumberOfCells(), 0);
  }
}

TEST(VtpFiles, SayWhereTheyCannotBeWritten) {
  const auto geometry = test_support::hopper_geometry();
  const auto snapshot = test_support::hopper_snapshot(geometry, 0);
  EXPECT_THROW(write_bodies_vtp("/nonexistent/b.vtp", geometry, snapshot), std::runtime_error);
  EXPECT_THROW(write_bodies_vtp("/nonexistent/b.vtp", test_support::mill_geometry(), snapshot), catalog::InputError);
}

}  // namespace
}  // namespace postprocess
