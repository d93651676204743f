// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <ostream>
#include <set>
#include <string>

#include "catalog/input_error.h"
#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/scan_file.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace shape_pipeline {
namespace {

using namespace test_support;

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string row(const std::string& prefix, const Point& p) {
  return prefix + number(p[0]) + " " + number(p[1]) + " " + number(p[2]) + "\n";
}

const catalog::TriangleMesh kBox = box_mesh({0, 0, 0}, {10, 20, 30});

std::string ascii_stl(const catalog::TriangleMesh& mesh) {
  std::string text = "solid box\n";
  for (const auto& face : mesh.faces) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const int v : face) text += row("  vertex ", mesh.vertices[v]);
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

std::string obj(const catalog::TriangleMesh& mesh, const std::string& heading) {
  std::string text = heading;
  for (const Point& p : mesh.vertices) text += row("v ", p);
  for (const auto& f : mesh.faces)
    text += "f " + std::to_string(f[0] + 1) + " " + std::to_string(f[1] + 1) + " " + std::to_string(f[2] + 1) + "\n";
  return text;
}

std::string off_or_ply(const catalog::TriangleMesh& mesh, std::string text) {
  for (const Point& p : mesh.vertices) text += row("", p);
  for (const auto& f : mesh.faces)
    text += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
  return text;
}

const char kPlyBox[] =
    "ply\nformat ascii 1.0\ncomment a box\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 12\nproperty list uchar int vertex_indices\nend_header\n";

/// Points on a unit sphere as rows.
std::string sphere_rows(int count, bool has_normals) {
  RandomStream random(1);
  std::string text;
  for (int i = 0; i < count; ++i) {
    const Point p = random.direction();
    std::string line = row("", p);
    if (has_normals) line.back() = ' ', line += row("", p);
    text += line;
  }
  return text;
}

std::string ply_cloud_header(int count) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
}

std::string pcd_header(int count, const std::string& storage) {
  const std::string n = std::to_string(count);
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " + storage + "\n";
}

TEST(MeshFile, EveryFormatGivesTheSameBoxInMetres) {
  const TemporaryFolder folder;
  write_text(folder / "a.stl", ascii_stl(kBox));
  write_stl(folder / "b.stl", kBox);
  write_text(folder / "c.obj", obj(kBox, "# box\no box\n"));
  write_text(folder / "d.off", off_or_ply(kBox, "OFF\n8 12 0\n"));
  write_text(folder / "e.ply", off_or_ply(kBox, kPlyBox));
  write_text(folder / "f.tab", obj(kBox, ""));
  for (const char* name : {"a.stl", "b.stl", "c.obj", "d.off", "e.ply", "f.tab"}) {
    EXPECT_EQ(scan_kind(folder / name), ScanKind::mesh) << name;
    const catalog::TriangleMesh mesh = read_mesh(folder / name, 1e-3);
    EXPECT_EQ(mesh.faces.size(), 12u) << name;
    EXPECT_NEAR(signed_volume(mesh), 6e-6, 1e-12) << name;
    EXPECT_NEAR(surface_area(mesh), 2.2e-3, 1e-9) << name;
  }
}

TEST(MeshFile, PolygonsBecomeTriangles) {
  const TemporaryFolder folder;
  std::string quads = "OFF\n8 6 0\n";
  for (const Point& p : kBox.vertices) quads += row("", p);
  quads += "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  write_text(folder / "quads.off", quads);
  EXPECT_NEAR(signed_volume(read_mesh(folder / "quads.off", 1)), 6000, 1e-3);
}

TEST(CloudFile, EveryFormatGivesTheSamePoints) {
  const TemporaryFolder folder;
  const std::string rows = sphere_rows(200, false);
  write_text(folder / "a.xyz", "# heading\n" + rows);
  write_text(folder / "b.ply", ply_cloud_header(200) + rows);
  write_text(folder / "c.pcd", pcd_header(200, "ascii") + rows);
  const PointCloud a = read_cloud(folder / "a.xyz", {}).cloud;
  write_cloud(folder / "d.ply", a);
  std::string binary = pcd_header(200, "binary");
  for (const Point& p : a.points)
    for (const double coordinate : p) {
      const auto single = static_cast<float>(coordinate);
      binary.append(reinterpret_cast<const char*>(&single), 4);
    }
  write_text(folder / "e.pcd", binary);
  for (const char* name : {"a.xyz", "b.ply", "c.pcd", "d.ply", "e.pcd"}) {
    EXPECT_EQ(scan_kind(folder / name), ScanKind::point_cloud) << name;
    CloudReading reading;
    reading.metres_per_unit = 0.01;
    const PointCloud cloud = read_cloud(folder / name, reading).cloud;
    ASSERT_EQ(cloud.points.size(), 200u) << name;
    EXPECT_FALSE(cloud.has_normals());
    for (std::size_t i = 0; i < 200; ++i)
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(cloud.points[i][k], 0.01 * a.points[i][k], 1e-8) << name;
  }
  EXPECT_EQ(read_cloud(folder / "d.ply", {}).cloud.points, a.points);
}

TEST(CloudFile, ReadsBigEndianPly) {
  const TemporaryFolder folder;
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 100\nproperty float x\nproperty uchar red\nproperty float y\n"
      "property float z\nend_header\n";
  RandomStream random(1);
  std::vector<Point> expected;
  for (int i = 0; i < 100; ++i) {
    const Point p = random.direction();
    expected.push_back(p);
    for (int k = 0; k < 3; ++k) {
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(p[k]));
      for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift & 255);
      if (k == 0) bytes += '\x7f';
    }
  }
  write_text(folder / "big.ply", bytes);
  const PointCloud cloud = read_cloud(folder / "big.ply", {}).cloud;
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(cloud.points[i][k], expected[i][k]);
}

TEST(CloudFile, TakesUnitNormalsAndLeavesColours) {
  const TemporaryFolder folder;
  write_text(folder / "n.xyz", sphere_rows(60, true));
  EXPECT_TRUE(read_cloud(folder / "n.xyz", {}).cloud.has_normals());
  std::string coloured;
  RandomStream random(1);
  for (int i = 0; i < 60; ++i) {
    coloured += row("", random.direction());
    coloured.back() = ' ';
    coloured += "200 190 180\n";
  }
  write_text(folder / "c.xyz", coloured);
  const CloudFile file = read_cloud(folder / "c.xyz", {});
  EXPECT_FALSE(file.cloud.has_normals());
  EXPECT_TRUE(file.had_unusable_normals);
}

TEST(CloudFile, DropsNanPointsOnlyWhenAsked) {
  const TemporaryFolder folder;
  write_text(folder / "n.xyz", sphere_rows(100, false) + "nan nan nan\n1 inf 2\n");
  try {
    read_cloud(folder / "n.xyz", {});
    FAIL() << "no error";
  } catch (const catalog::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("2 of 102 points"), std::string::npos) << error.what();
  }
  CloudReading reading;
  reading.drops_nan_points = true;
  const CloudFile file = read_cloud(folder / "n.xyz", reading);
  EXPECT_EQ(file.cloud.points.size(), 100u);
  EXPECT_EQ(file.dropped_nan_points, 2u);
}

TEST(CloudFile, OfAVeryLargeOneASampleIsKeptInOrderAndSaid) {
  const TemporaryFolder folder;
  const std::string rows = sphere_rows(1000, true);
  write_text(folder / "n.xyz", rows);
  write_text(folder / "n.ply",
             "ply\nformat ascii 1.0\nelement vertex 1000\nproperty double x\nproperty double y\nproperty double z\n"
             "property double nx\nproperty double ny\nproperty double nz\nend_header\n" +
                 rows);
  write_text(folder / "n.pcd",
             "VERSION 0.7\nFIELDS x y z normal_x normal_y normal_z\nSIZE 8 8 8 8 8 8\nTYPE F F F F F F\n"
             "COUNT 1 1 1 1 1 1\nWIDTH 1000\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1000\nDATA ascii\n" +
                 rows);
  const PointCloud whole = read_cloud(folder / "n.xyz", {}).cloud;
  CloudReading reading;
  reading.point_limit = 130;
  for (const char* name : {"n.xyz", "n.ply", "n.pcd"}) {
    const CloudFile file = read_cloud(folder / name, reading);
    ASSERT_EQ(file.cloud.points.size(), 125u) << name << ": one of every eight";
    EXPECT_EQ(file.left_out_points, 875u) << name;
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].name, "subsampled_points");
    EXPECT_EQ(file.notes[0].figure, 875);
    std::set<std::size_t> places;
    for (std::size_t block = 0; block < 125; ++block) {
      const auto begin = whole.points.begin() + static_cast<std::ptrdiff_t>(8 * block);
      const auto found = std::find(begin, begin + 8, file.cloud.points[block]);
      ASSERT_NE(found, begin + 8) << name << ", block " << block;
      EXPECT_EQ(file.cloud.normals[block], whole.normals[static_cast<std::size_t>(found - whole.points.begin())]);
      places.insert(static_cast<std::size_t>(found - begin));
    }
    EXPECT_EQ(places.size(), 8u) << "at random in its block";
  }
}

struct BadFile {
  const char* name;
  std::function<std::string()> contents;
  const char* expected;  // part of the message
};

void PrintTo(const BadFile& bad, std::ostream* out) { *out << bad.expected; }

std::string cut(const std::string& text, double share) {
  return text.substr(0, static_cast<std::size_t>(share * static_cast<double>(text.size())));
}

std::string binary_stl() {
  const TemporaryFolder folder;
  write_stl(folder / "b.stl", kBox);
  std::ifstream stream(folder / "b.stl", std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string flat_rows(bool is_line) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += row("", {i * 1.0, is_line ? 2.0 * i : (i * 37) % 100 * 1.0, 3.0 * i});
  return text;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

class BadScan : public testing::TestWithParam<BadFile> {};

TEST_P(BadScan, GetsOneClearLine) {
  const TemporaryFolder folder;
  const auto path = folder / GetParam().name;
  write_text(path, GetParam().contents());
  try {
    if (scan_kind(path) == ScanKind::mesh)
      read_mesh(path, 1);
    else
      read_cloud(path, {});
    FAIL() << "no error, expected: " << GetParam().expected;
  } catch (const catalog::InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(GetParam().expected), std::string::npos) << message;
    EXPECT_EQ(message.find(path.string()), 0u) << message;
    EXPECT_NE(message.find("; "), std::string::npos) << "no remedy: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

const BadFile kBadFiles[] = {
    {"empty.ply", [] { return std::string(); }, "the file is empty"},
    {"empty.xyz", [] { return std::string(); }, "the file is empty"},
    {"empty.stl", [] { return std::string(); }, "the file is empty"},
    {"image.ply", [] { return std::string("\x89PNG\r\n\x1a\n....", 12); }, "line 1: expected 'ply'"},
    {"image.stl", [] { return "\x89PNG\r\n" + std::string(200, 'x'); }, "truncated or no STL"},
    {"image.obj", [] { return std::string("\x89PNG\r\n\x1a\n....", 12); }, "expected a line of an OBJ"},
    {"image.off", [] { return std::string("\x89PNG\r\n\x1a\n....", 12); }, "line 1: expected 'OFF'"},
    {"image.pcd", [] { return std::string("\x89PNG\r\n\x1a\n....", 12); }, "expected a PCD header line"},
    {"image.xyz", [] { return std::string("\x89PNG\r\n\x1a\n....", 12); }, "line 1: expected 'x y z'"},
    {"notes.doc", [] { return std::string("text"); }, "'.doc' is no scan format"},
    {"header.ply", [] { return std::string("ply\nformat ascii 1.0\nelement vertex 9\n"); }, "'end_header' is missing"},
    {"word.ply", [] { return with(kPlyBox, "comment", "commend"); }, "line 3: expected 'format'"},
    {"type.ply", [] { return with(kPlyBox, "float x", "flaot x"); }, "expected a PLY number type"},
    {"no_x.ply", [] { return with(off_or_ply(kBox, kPlyBox), "float x", "float q"); }, "properties x, y and z"},
    {"cut.ply", [] { return cut(ply_cloud_header(100) + sphere_rows(100, false), 0.7); }, "of 100: the file ends here"},
    {"long.ply", [] { return ply_cloud_header(90) + sphere_rows(100, false); }, "more than the header declares"},
    {"cut_faces.ply", [] { return cut(off_or_ply(kBox, kPlyBox), 0.9); }, "of 12: the file ends here"},
    {"index.ply", [] { return with(off_or_ply(kBox, kPlyBox), "3 5 7 6", "3 5 7 8"); }, "vertex index 8 is not in"},
    {"cut.stl", [] { return cut(binary_stl(), 0.6); }, "12 triangles need 684 bytes, the file has 410"},
    {"long.stl", [] { return binary_stl() + "tail"; }, "has 4 bytes more than its 12 triangles need"},
    {"cut_ascii.stl", [] { return cut(ascii_stl(kBox), 0.5); }, "truncated"},
    {"nan.stl", [] { return with(ascii_stl(kBox), "vertex 0 0 0", "vertex 0 nan 0"); }, "a coordinate is no number"},
    {"nan_binary.stl",
     [] {
       std::string bytes = binary_stl();
       const float nan = std::numeric_limits<float>::quiet_NaN();
       std::memcpy(&bytes[84 + 12], &nan, 4);
       return bytes;
     },
     "no number"},
    {"cut.obj",
     [] {
       return obj({kBox.vertices, {{0, 1, 2}, {0, 1, 30}}}, "");
     },
     "vertex index 31 is out of range, the file has 8 vertices"},
    {"points.obj",
     [] {
       return obj({kBox.vertices, {}}, "");
     },
     "no faces"},
    {"word.obj", [] { return with(obj(kBox, ""), "v 0 0 0", "v 0 zero 0"); }, "line 1: expected three coordinates"},
    {"cut.off", [] { return cut(off_or_ply(kBox, "OFF\n8 12 0\n"), 0.8); }, "face "},
    {"index.off", [] { return with(off_or_ply(kBox, "OFF\n8 12 0\n"), "3 5 7 6", "3 5 7 9"); }, "vertex index 9"},
    {"cut.tab", [] { return cut(obj(kBox, ""), 0.97) + "\nf 3 7"; }, "expected 'v x y z' or 'f i j k'"},
    {"index.tab", [] { return obj(kBox, "") + "f 1 2 9\n"; }, "expected vertex numbers from 1 to 8"},
    {"cut.pcd", [] { return cut(pcd_header(100, "ascii") + sphere_rows(100, false), 0.6); }, "point"},
    {"blank_line.pcd", [] { return "\r\n" + pcd_header(100, "ascii") + sphere_rows(100, false); }, "line of blanks"},
    {"blanks.pcd", [] { return " \n" + pcd_header(100, "ascii") + sphere_rows(100, false); }, "line of blanks"},
    {"cut_binary.pcd", [] { return pcd_header(100, "binary") + std::string(600, 'x'); },
     "expected 100 points, found 50"},
    {"few.xyz", [] { return sphere_rows(20, false); }, "expected at least 50 points, found 20"},
    {"row.xyz", [] { return sphere_rows(60, false) + "1 2\n"; }, "line 61: expected 'x y z'"},
    {"width.xyz", [] { return sphere_rows(60, false) + "1 2 3 4\n"; }, "line 61: expected 3 numbers"},
    {"plane.xyz", [] { return flat_rows(false); }, "all points lie in one plane"},
    {"line.xyz", [] { return flat_rows(true); }, "all points lie on one line"},
    {"spot.xyz",
     [] {
       std::string text;
       for (int i = 0; i < 60; ++i) text += "1 2 3\n";
       return text;
     },
     "all points are in one place"},
    {"plane.off", [] { return std::string("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"); },
     "all points lie in one plane"},
    {"far.obj",
     [] {
       return obj(moved(kBox, 1, {5e7, 0, 0}), "");
     },
     "single precision blurs it"}};

INSTANTIATE_TEST_SUITE_P(Files, BadScan, testing::ValuesIn(kBadFiles), [](const auto& instance) {
  std::string name = instance.param.name;
  for (char& c : name)
    if (c == '.') c = '_';
  return name;
});

TEST(ScanFile, MissingFilesAndFoldersAreNamed) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_mesh(folder / "none.stl", 1), catalog::InputError);
  EXPECT_THROW(read_cloud(folder / "none.xyz", {}), catalog::InputError);
  EXPECT_THROW(scan_files({folder.path()}), catalog::InputError);
  write_text(folder / "b.stl", "x");
  write_text(folder / "a.ply", "x");
  write_text(folder / "truth.json", "x");
  const auto files = scan_files({folder.path()});
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].filename(), "a.ply");
}

}  // namespace
}  // namespace shape_pipeline
