// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "catalog/input_error.h"
#include "dem_gpu/io/hdf5_file.h"
#include "dem_gpu/snapshot.h"
#include "tests/support/temporary_folder.h"

namespace dem_gpu {
namespace {

using test_support::read_bytes;
using test_support::TemporaryFolder;
using test_support::write_bytes;

Snapshot sample_snapshot(int bodies, int walls, int contacts, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
  const auto turn = [&] { return normalized({uniform(random), uniform(random), uniform(random), uniform(random)}); };
  Snapshot snapshot;
  snapshot.time = uniform(random);
  snapshot.step = 123456789012;
  for (int b = 0; b < bodies; ++b) {
    snapshot.active.push_back(b % 3 != 0);
    snapshot.position.push_back(vector());
    snapshot.orientation.push_back(turn());
    snapshot.velocity.push_back(vector());
    snapshot.angular_velocity.push_back(vector());
  }
  for (int w = 0; w < walls; ++w) {
    snapshot.wall_translation.push_back(vector());
    snapshot.wall_rotation.push_back(turn());
    snapshot.wall_present.push_back(w != 1);
  }
  for (int c = 0; c < contacts; ++c)
    snapshot.contacts.push_back({c % bodies, -1 - c % walls, vector(), vector(), uniform(random)});
  return snapshot;
}

bool is_equal(const SnapshotContact& a, const SnapshotContact& b) {
  return a.body_a == b.body_a && a.body_b == b.body_b && a.point == b.point && a.force == b.force &&
         a.overlap == b.overlap;
}

catalog::ConvexPart tetrahedron(double size) {
  catalog::ConvexPart part;
  part.vertices = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
  const double s = 1 / std::sqrt(3.0);
  part.faces = {{{0, 2, 1}, {{0, 0, -1}, 0}, catalog::FaceKind::inner},
                {{0, 1, 3}, {{0, -1, 0}, 0}, catalog::FaceKind::outer},
                {{0, 3, 2}, {{-1, 0, 0}, 0}, catalog::FaceKind::outer},
                {{1, 2, 3}, {{s, s, s}, size * s}, catalog::FaceKind::outer}};
  return part;
}

RunGeometry sample_geometry() {
  RunGeometry geometry;
  geometry.shapes = {{"two parts", 0, {tetrahedron(0.1), tetrahedron(0.2)}, 1.5e-3}, {"ball", 0.02, {}, 3.35e-5}};
  geometry.materials = {"ore", "steel"};
  geometry.material_density = {2700, 7850};
  geometry.body_shape = {0, 1, 0};
  geometry.body_material = {0, 1, 0};
  geometry.body_scale = {1, 1, 0.5};
  geometry.body_mass = {4.05, 0.263, 0.506};
  geometry.walls.resize(3);
  geometry.walls[0] = {"shell", "shell", WallKind::cylinder, {1, 2, 3}, {0, 1, 0}, 0.4, 0.5, 0, {}};
  geometry.walls[1].name = "lifter 1";
  geometry.walls[1].contact_class = "lifter";
  geometry.walls[1].kind = WallKind::volume_object;
  geometry.walls[1].part = tetrahedron(0.3);
  geometry.walls[2].name = "chute";
  geometry.walls[2].kind = WallKind::mesh;
  geometry.walls[2].mesh = {{{0, 0, 0.1}, {1, 0, 0.2}, {0, 1, 0.3}, {1, 1, 0.4}}, {{0, 1, 2}, {1, 3, 2}}};
  return geometry;
}

void expect_equal(const catalog::ConvexPart& a, const catalog::ConvexPart& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    EXPECT_EQ(a.faces[f].vertices, b.faces[f].vertices);
    EXPECT_EQ(a.faces[f].plane.normal, b.faces[f].plane.normal);
    EXPECT_EQ(a.faces[f].plane.offset, b.faces[f].plane.offset);
    EXPECT_EQ(a.faces[f].kind, b.faces[f].kind);
  }
}

TEST(SnapshotFile, RoundTripIsExact) {
  const TemporaryFolder folder;
  const Snapshot written = sample_snapshot(500, 3, 1234);
  write_snapshot(folder / "s.h5", written);
  const Snapshot back = read_snapshot(folder / "s.h5");
  EXPECT_EQ(back.time, written.time);
  EXPECT_EQ(back.step, written.step);
  EXPECT_EQ(back.active, written.active);
  EXPECT_EQ(back.position, written.position);
  EXPECT_EQ(back.orientation, written.orientation);
  EXPECT_EQ(back.velocity, written.velocity);
  EXPECT_EQ(back.angular_velocity, written.angular_velocity);
  EXPECT_EQ(back.wall_translation, written.wall_translation);
  EXPECT_EQ(back.wall_rotation, written.wall_rotation);
  EXPECT_EQ(back.wall_present, written.wall_present);
  ASSERT_EQ(back.contacts.size(), written.contacts.size());
  for (std::size_t c = 0; c < back.contacts.size(); ++c)
    EXPECT_TRUE(is_equal(back.contacts[c], written.contacts[c])) << c;
}

TEST(SnapshotFile, HoldsASceneWithoutWallsAndContacts) {
  const TemporaryFolder folder;
  write_snapshot(folder / "s.h5", sample_snapshot(1, 0, 0));
  const Snapshot back = read_snapshot(folder / "s.h5");
  EXPECT_EQ(back.position.size(), 1u);
  EXPECT_TRUE(back.wall_present.empty());
  EXPECT_TRUE(back.contacts.empty());
}

TEST(SnapshotFile, EqualStatesGiveEqualBytes) {
  const TemporaryFolder folder;
  write_snapshot(folder / "a.h5", sample_snapshot(300, 2, 77));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 stamps times in whole seconds
  write_snapshot(folder / "b.h5", sample_snapshot(300, 2, 77));
  write_snapshot(folder / "c.h5", sample_snapshot(300, 2, 77, 2));
  EXPECT_EQ(read_bytes(folder / "a.h5"), read_bytes(folder / "b.h5"));
  EXPECT_NE(read_bytes(folder / "a.h5"), read_bytes(folder / "c.h5"));
}

TEST(SnapshotFile, RefusesTruncatedAndWrongFiles) {
  const TemporaryFolder folder;
  write_snapshot(folder / "s.h5", sample_snapshot(300, 2, 77));
  const std::string whole = read_bytes(folder / "s.h5");
  for (std::size_t tenth = 0; tenth < 10; ++tenth) {
    write_bytes(folder / "cut.h5", whole.substr(0, whole.size() * tenth / 10));
    EXPECT_THROW(read_snapshot(folder / "cut.h5"), catalog::InputError) << tenth;
  }
  write_geometry(folder / "geometry.h5", sample_geometry());
  EXPECT_THROW(read_snapshot(folder / "geometry.h5"), catalog::InputError);
  EXPECT_THROW(read_geometry(folder / "s.h5"), catalog::InputError);
  EXPECT_THROW(read_snapshot(folder / "absent.h5"), catalog::InputError);
}

TEST(SnapshotFile, RefusesAContactWithABodyThatIsNotThere) {
  const TemporaryFolder folder;
  Snapshot snapshot = sample_snapshot(4, 2, 3);
  snapshot.contacts[1].body_b = 4;
  write_snapshot(folder / "s.h5", snapshot);
  EXPECT_THROW(read_snapshot(folder / "s.h5"), catalog::InputError);
  snapshot.contacts[1].body_b = -3;
  write_snapshot(folder / "s.h5", snapshot);
  EXPECT_THROW(read_snapshot(folder / "s.h5"), catalog::InputError);
}

TEST(SnapshotFile, AreListedByNumber) {
  const TemporaryFolder folder;
  EXPECT_TRUE(snapshot_files(folder.path()).empty());
  std::filesystem::create_directories(folder / "snapshots");
  for (const char* name : {"snapshot_000010.h5", "snapshot_1000000.h5", "snapshot_000009.h5", "snapshot_000011.h5.part",
                           "notes.txt", "snapshot_x.h5"})
    write_bytes(folder.path() / "snapshots" / name, "");
  const auto files = snapshot_files(folder.path());
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].filename(), "snapshot_000009.h5");
  EXPECT_EQ(files[1].filename(), "snapshot_000010.h5");
  EXPECT_EQ(files[2].filename(), "snapshot_1000000.h5");
}

TEST(GeometryFile, RoundTripIsExact) {
  const TemporaryFolder folder;
  const RunGeometry written = sample_geometry();
  write_geometry(folder / "g.h5", written);
  const RunGeometry back = read_geometry(folder / "g.h5");
  ASSERT_EQ(back.shapes.size(), 2u);
  EXPECT_EQ(back.shapes[0].name, "two parts");
  EXPECT_EQ(back.shapes[1].sphere_radius, 0.02);
  EXPECT_EQ(back.shapes[0].volume, 1.5e-3);
  ASSERT_EQ(back.shapes[0].parts.size(), 2u);
  for (int p = 0; p < 2; ++p) expect_equal(back.shapes[0].parts[p], written.shapes[0].parts[p]);
  EXPECT_EQ(back.materials, written.materials);
  EXPECT_EQ(back.material_density, written.material_density);
  EXPECT_EQ(back.body_shape, written.body_shape);
  EXPECT_EQ(back.body_material, written.body_material);
  EXPECT_EQ(back.body_scale, written.body_scale);
  EXPECT_EQ(back.body_mass, written.body_mass);
  ASSERT_EQ(back.walls.size(), 3u);
  EXPECT_EQ(back.walls[0].kind, WallKind::cylinder);
  EXPECT_EQ(back.walls[0].point, (Vec3{1, 2, 3}));
  EXPECT_EQ(back.walls[0].length, 0.4);
  EXPECT_EQ(back.walls[0].base_radius, 0.5);
  EXPECT_EQ(back.walls[1].contact_class, "lifter");
  expect_equal(back.walls[1].part, written.walls[1].part);
  EXPECT_TRUE(back.walls[1].mesh.vertices.empty());
  EXPECT_EQ(back.walls[2].kind, WallKind::mesh);
  EXPECT_EQ(back.walls[2].mesh.vertices, written.walls[2].mesh.vertices);
  EXPECT_EQ(back.walls[2].mesh.faces, written.walls[2].mesh.faces);
}

TEST(GeometryFile, EqualGeometriesGiveEqualBytes) {
  const TemporaryFolder folder;
  write_geometry(folder / "a.h5", sample_geometry());
  write_geometry(folder / "b.h5", sample_geometry());
  EXPECT_EQ(read_bytes(folder / "a.h5"), read_bytes(folder / "b.h5"));
}

TEST(GeometryFile, RefusesABodyOfAShapeThatIsNotThere) {
  const TemporaryFolder folder;
  RunGeometry geometry = sample_geometry();
  geometry.body_shape[2] = 2;
  write_geometry(folder / "g.h5", geometry);
  EXPECT_THROW(read_geometry(folder / "g.h5"), catalog::InputError);
}

}  // namespace
}  // namespace dem_gpu
