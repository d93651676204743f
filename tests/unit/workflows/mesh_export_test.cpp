// SPDX-License-Identifier: Apache-2.0
#include "workflows/mesh_export.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace workflows;
using namespace test_support;

template <class Value>
Value at(const std::string& bytes, std::size_t offset) {
  Value value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

ExportMesh two_boxes() {
  return joined({box_part({-1, 0, 0}, {0.25, 1.0 / 3, 1}), box_part({0.25, 0, 0}, {2, 1.0 / 3, 1})});
}

TEST(MeshExport, JoinedPartsKeepTheirVolumeAndNumbers) {
  const ExportMesh shape = two_boxes();
  EXPECT_NEAR(volume_moments(shape.mesh).volume, 1, 1e-15);
  ASSERT_EQ(shape.part.size(), 24u);
  EXPECT_EQ(shape.part[11], 0);
  EXPECT_EQ(shape.part[12], 1);
}

TEST(MeshExport, StlLayout) {
  const std::string bytes = stl_bytes({box_mesh({0, 0, 0}, {1, 2, 3}), {}});
  ASSERT_EQ(bytes.size(), 80u + 4 + 12 * 50);
  EXPECT_NE(bytes.substr(0, 5), "solid");
  EXPECT_EQ(at<std::uint32_t>(bytes, 80), 12u);
  double volume = 0;
  for (std::size_t f = 0; f < 12; ++f) {
    float n[3], v[9];
    std::memcpy(n, bytes.data() + 84 + 50 * f, sizeof n);
    std::memcpy(v, bytes.data() + 84 + 50 * f + 12, sizeof v);
    EXPECT_FLOAT_EQ(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1);
    const double height = n[0] * (v[0] - 0.5) + n[1] * (v[1] - 1) + n[2] * (v[2] - 1.5);
    EXPECT_GT(height, 0) << "normals point out";
    volume +=
        (v[0] * (v[4] * v[8] - v[5] * v[7]) + v[1] * (v[5] * v[6] - v[3] * v[8]) + v[2] * (v[3] * v[7] - v[4] * v[6])) /
        6;
  }
  EXPECT_NEAR(volume, 6, 1e-5);
}

TEST(MeshExport, PlyHoldsEveryBitAndThePart) {
  const ExportMesh shape = two_boxes();
  const std::string bytes = ply_bytes(shape);
  const std::size_t start = bytes.find("end_header\n") + 11;
  ASSERT_EQ(bytes.size(), start + 16 * 24 + 24 * (1 + 12 + 4));
  EXPECT_EQ(at<double>(bytes, start + 24 * 2 + 8), 1.0 / 3);
  EXPECT_EQ(at<std::int32_t>(bytes, bytes.size() - 4), 1);
  EXPECT_EQ(ply_bytes({shape.mesh, {}}).find("property int part"), std::string::npos);
}

TEST(MeshExport, OffReadsBackExactly) {
  const ExportMesh shape = two_boxes();
  std::istringstream text(off_bytes(shape));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "OFF");
  std::getline(text, line);
  std::size_t vertices = 0, faces = 0, edges = 0;
  text >> vertices >> faces >> edges;
  ASSERT_EQ(vertices, 16u);
  ASSERT_EQ(faces, 24u);
  for (const catalog::Point& vertex : shape.mesh.vertices)
    for (const double coordinate : vertex) {
      text >> line;
      EXPECT_EQ(std::stod(line), coordinate);
    }
  for (const catalog::Triangle& face : shape.mesh.faces) {
    int corners = 0, a = 0, b = 0, c = 0;
    text >> corners >> a >> b >> c;
    EXPECT_EQ(corners, 3);
    EXPECT_EQ((catalog::Triangle{a, b, c}), face);
  }
}

TEST(WriteFile, ReplacesWholeAndLeavesNothingBeside) {
  const TemporaryFolder folder;
  write_file(folder / "a.off", "old");
  write_file(folder / "a.off", "new");
  std::ifstream file(folder / "a.off");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  EXPECT_THROW(write_file(folder / "missing/a.off", "x"), catalog::InputError);
  EXPECT_THROW(write_file(folder.path(), "x"), catalog::InputError);
}

}  // namespace
