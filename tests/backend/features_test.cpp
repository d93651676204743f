// SPDX-License-Identifier: Apache-2.0
// What a scene does not need is not there: no pass, no column.
#include <gtest/gtest.h>

#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/io/hdf5_file.h"
#include "dem_gpu/simulation.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/periodic_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wall_meshes.h"

namespace {

using namespace test_support;
using Names = std::vector<std::string>;

Names passes(const dem_gpu::Scene& scene) { return dem_gpu::Simulation(scene).pass_names(); }

dem_gpu::Scene spheres() {
  dem_gpu::Scene scene = empty_scene(0.5, 0);
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.01), box_shape({0.02, 0.02, 0.02})};
  scene.bodies = {body_at(0, {0, 0, 1}), body_at(0, {1, 0, 1})};
  return scene;
}

TEST(Absent, PassesOfWhatIsNotThere) {
  dem_gpu::Scene scene = spheres();
  EXPECT_EQ(passes(scene), (Names{"advance_bodies", "neighbour_list", "sphere_contacts", "gather_forces"}));
  scene.bodies.resize(1);
  EXPECT_EQ(passes(scene), (Names{"advance_bodies", "neighbour_list", "gather_forces"}));
  scene.walls = {floor_wall()};
  EXPECT_EQ(passes(scene), (Names{"advance_bodies", "neighbour_list", "sphere_wall_contacts", "gather_forces"}));
  scene.bodies[0].shape = 1;
  EXPECT_EQ(passes(scene), (Names{"advance_bodies", "neighbour_list", "polyhedron_wall_contacts", "gather_forces"}));
  scene.walls[0].geometry = dem_gpu::VolumeObject{dem_gpu::box_part({1, 1, 1})};
  EXPECT_EQ(passes(scene), (Names{"advance_bodies", "neighbour_list", "polyhedron_object_contacts", "gather_forces"}));
  scene.walls[0].motion.velocity = {0, 0, 1};
  scene.outflow = dem_gpu::Outflow{};
  EXPECT_EQ(passes(scene), (Names{"advance_bodies", "advance_walls", "neighbour_list", "polyhedron_object_contacts",
                                  "gather_forces", "outflow"}));
  scene.walls[0].geometry = dem_gpu::MeshObject{flat_sheet(1, 2), 0.1};
  scene.outflow.reset();
  EXPECT_EQ(passes(scene),
            (Names{"advance_bodies", "advance_walls", "neighbour_list", "polyhedron_mesh_contacts", "gather_forces"}));
  EXPECT_EQ(passes(mixed_scene()).size(), 13u) << "everything but meshes and a periodic box";
  scene = spheres();
  scene.periodic = periodic_box({-0.1, -0.1, 0}, {2, 1, 2}, "xz");
  EXPECT_EQ(passes(scene),
            (Names{"advance_bodies", "neighbour_list", "update_ghosts", "sphere_contacts", "gather_forces"}));
}

TEST(Absent, SeamsAreCrossedOnlyWhereThereAreSome) {
  dem_gpu::Scene scene = spheres();
  scene.bodies.resize(1);
  const auto block_at = [](const std::string& name, Real x) {
    dem_gpu::Wall wall;
    wall.name = name;
    wall.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({1, 1, 1}), {}, {x, 0, 0})};
    return wall;
  };
  const Names apart{"advance_bodies", "neighbour_list", "sphere_object_contacts", "gather_forces"};
  scene.walls = {block_at("left", 0), block_at("right", 1.01)};
  EXPECT_EQ(passes(scene), apart);
  scene.walls = {block_at("left", 0), block_at("right", 1)};
  EXPECT_EQ(passes(scene),
            (Names{"advance_bodies", "neighbour_list", "seam_crossings", "sphere_object_contacts", "gather_forces"}));
  scene.walls[1].removed_at = 1;
  EXPECT_EQ(passes(scene),
            (Names{"advance_bodies", "advance_walls", "neighbour_list", "sphere_object_contacts", "gather_forces"}))
      << "not one solid";
  scene.walls = {block_at("left", 0), block_at("right", 1)};
  scene.bodies[0].shape = 1;
  EXPECT_EQ(passes(scene), (Names{"advance_bodies", "neighbour_list", "polyhedron_object_contacts", "gather_forces"}));
}

TEST(Absent, ColumnsOfWhatIsNotThere) {
  const auto lengths = [](const dem_gpu::ContactFeatures& features) {
    dem_gpu::ContactColumns columns;
    resize_columns(columns, 10, features);
    return std::vector<std::size_t>{columns.row.size(),
                                    columns.cache_begin.size(),
                                    columns.elastic_work.size(),
                                    columns.last_friction_force.size(),
                                    columns.wall_impulse.size(),
                                    columns.turning_displacement.size(),
                                    columns.last_friction_couple.size(),
                                    columns.spring_normal.size(),
                                    columns.facet_begin.size(),
                                    columns.orbit_loss.size()};
  };
  using Lengths = std::vector<std::size_t>;
  EXPECT_EQ(lengths({}), (Lengths{10, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(lengths({true, false, false, false, false}), (Lengths{10, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(lengths({false, true, false, false, false}), (Lengths{10, 0, 10, 10, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(lengths({false, false, true, false, false}), (Lengths{10, 0, 0, 0, 10, 0, 0, 0, 0, 0}));
  EXPECT_EQ(lengths({false, false, false, true, false}), (Lengths{10, 11, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(lengths({true, false, false, true, true}), (Lengths{10, 11, 0, 0, 0, 10, 0, 10, 0, 0}));
  EXPECT_EQ(lengths({true, true, false, true, true}), (Lengths{10, 11, 10, 10, 0, 10, 10, 10, 0, 0}));
  dem_gpu::ContactFeatures at_meshes;
  at_meshes.has_meshes = true;
  EXPECT_EQ(lengths(at_meshes), (Lengths{10, 0, 0, 0, 0, 0, 0, 0, 11, 0}));
  dem_gpu::ContactFeatures rolling_spheres;
  rolling_spheres.has_spheres = true;
  EXPECT_EQ(lengths(rolling_spheres), (Lengths{10, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  rolling_spheres.has_ledger = true;
  EXPECT_EQ(lengths(rolling_spheres), (Lengths{10, 0, 10, 10, 0, 0, 0, 0, 0, 10}));
  rolling_spheres.has_ledger = false;
  rolling_spheres.has_friction_couples = true;
  EXPECT_EQ(lengths(rolling_spheres), (Lengths{10, 0, 0, 0, 0, 10, 0, 0, 0, 0}));
}

TEST(Absent, GhostsOfWhatIsNotPeriodic) {
  const auto lengths = [](const dem_gpu::Scene& scene) {
    const TemporaryFolder folder;
    dem_gpu::Simulation(scene).write_checkpoint(folder.path());
    const int any_version = 99;
    const dem_gpu::io::Hdf5Reader file(folder / "checkpoint.h5", "talus-checkpoint", any_version);
    return std::vector<std::size_t>{file.read<std::int64_t>("ghosts/id").size(),
                                    file.read<double>("ghosts/wraps", 3).size() / 3,
                                    file.read<double>("bodies/position", 3).size() / 3};
  };
  using Lengths = std::vector<std::size_t>;
  dem_gpu::Scene scene = spheres();
  EXPECT_EQ(lengths(scene), (Lengths{0, 0, 2}));
  scene.periodic = periodic_box({-0.1, -0.1, 0}, {2, 1, 2});
  EXPECT_EQ(lengths(scene), (Lengths{0, 2, 2})) << "no body near a face";
  scene.periodic = periodic_box({-0.001, -0.001, 0}, {2, 1, 2}, "xy");
  EXPECT_EQ(lengths(scene), (Lengths{1 + 2 + 1, 2, 6})) << "one body at an edge, one at a face";
}

TEST(Absent, MotionIsTheSameWithoutTheLedger) {
  dem_gpu::Scene scene = mixed_scene();
  dem_gpu::Simulation with(scene);
  scene.energy_ledger = false;
  dem_gpu::Simulation without(scene);
  with.advance(1500);
  without.advance(1500);
  EXPECT_EQ(with.snapshot().position, without.snapshot().position);
  EXPECT_EQ(without.ledger().throughput, 0);
  EXPECT_EQ(without.ledger().kinetic, 0);
}

}  // namespace
