// SPDX-License-Identifier: Apache-2.0
// Broken anywhere and resumed, a run ends in the same bytes.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "catalog/input_error.h"
#include "dem_gpu/io/hdf5_file.h"
#include "tests/support/dem_runs.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/periodic_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wall_meshes.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr int kSteps = 5000;

std::string snapshot_bytes(const Simulation& simulation, const TemporaryFolder& folder) {
  dem_gpu::write_snapshot(folder / "snapshot.h5", simulation.snapshot());
  return read_bytes(folder / "snapshot.h5");
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Checkpoint, ResumedRunEndsInTheSameBytes) {
  const TemporaryFolder folder;
  Simulation unbroken(mixed_scene());
  unbroken.advance(kSteps);
  const std::string expected = snapshot_bytes(unbroken, folder);
  const auto ledger = unbroken.ledger();
  for (const int broken_at : {0, 1, 1234, 3999, 4000, 4001, 4999}) {  // the gate opens at step 4000
    Simulation first(mixed_scene());
    first.advance(broken_at);
    first.write_checkpoint(folder.path());
    Simulation second(mixed_scene());
    second.read_checkpoint(folder.path());
    EXPECT_EQ(second.step(), broken_at);
    second.advance(kSteps - broken_at);
    EXPECT_EQ(snapshot_bytes(second, folder), expected) << "broken at step " << broken_at;
    const auto resumed = second.ledger();
    EXPECT_EQ(resumed.imbalance(), ledger.imbalance());
    EXPECT_EQ(resumed.throughput, ledger.throughput);
    EXPECT_EQ(second.quality().largest_overlap, unbroken.quality().largest_overlap);
  }
}

/// The mixed scene in a turning drum that is a mesh, on a shaking plate.
Scene mesh_scene() {
  Scene scene = mixed_scene();
  const dem_gpu::Motion turning = scene.walls[0].motion;
  catalog::TriangleMesh drum = drum_mesh(0.1, 0.08, 24);
  for (catalog::Point& p : drum.vertices) p[1] -= 0.04;
  scene.walls[0] = mesh_wall("shell", drum);
  std::get<dem_gpu::MeshObject>(scene.walls[0].geometry).is_container = true;
  scene.walls[0].motion = turning;
  catalog::TriangleMesh plate = flat_sheet(0.1, 3);
  for (catalog::Point& p : plate.vertices) p[2] -= 0.055;
  scene.walls[2] = mesh_wall("gate", plate, 0.01);
  scene.walls[2].motion.amplitude = {0, 0, 0.001};
  scene.walls[2].motion.frequency = 60;
  return scene;
}

TEST(Checkpoint, MovingMeshesResumeInTheSameBytes) {
  const TemporaryFolder folder;
  Simulation unbroken(mesh_scene());
  unbroken.advance(2500);
  const std::string expected = snapshot_bytes(unbroken, folder);
  EXPECT_GT(unbroken.bulk().contacts, 5);
  for (const int broken_at : {1, 1777}) {
    Simulation first(mesh_scene());
    first.advance(broken_at);
    first.write_checkpoint(folder.path());
    Simulation second(mesh_scene());
    second.read_checkpoint(folder.path());
    second.advance(2500 - broken_at);
    EXPECT_EQ(snapshot_bytes(second, folder), expected) << "broken at step " << broken_at;
  }
}

TEST(Checkpoint, PeriodicRunResumesInTheSameBytes) {
  const TemporaryFolder folder;
  Simulation unbroken(periodic_incline());
  unbroken.advance(6000);
  const std::string expected = snapshot_bytes(unbroken, folder);
  EXPECT_GT(unbroken.bulk().contacts, 5);
  for (const int broken_at : {0, 1, 1111, 3456, 5999}) {
    Simulation first(periodic_incline());
    first.advance(broken_at);
    first.write_checkpoint(folder.path());
    Simulation second(periodic_incline());
    second.read_checkpoint(folder.path());
    second.advance(6000 - broken_at);
    EXPECT_EQ(snapshot_bytes(second, folder), expected) << "broken at step " << broken_at;
    EXPECT_EQ(second.ledger().gravitational, unbroken.ledger().gravitational);
    EXPECT_EQ(second.ledger().imbalance(), unbroken.ledger().imbalance());
  }
  dem_gpu::Scene wider = periodic_incline();
  wider.periodic->span[0]->high += 0.001;
  Simulation other(wider);
  EXPECT_NE(refusal([&] { other.read_checkpoint(folder.path()); }).find("another scene"), std::string::npos);
}

TEST(Checkpoint, IsTheSameBytesEachTime) {
  const TemporaryFolder one, two;
  for (const TemporaryFolder* folder : {&one, &two}) {
    Simulation simulation(mixed_scene());
    simulation.advance(500);
    simulation.write_checkpoint(folder->path());
  }
  EXPECT_EQ(read_bytes(one / "checkpoint.h5"), read_bytes(two / "checkpoint.h5"));
}

TEST(Checkpoint, KeepsThePreviousOneAndUsesItWhenTheLastIsDamaged) {
  const TemporaryFolder folder;
  Simulation simulation(mixed_scene());
  simulation.advance(300);
  simulation.write_checkpoint(folder.path());
  simulation.advance(300);
  simulation.write_checkpoint(folder.path());
  const std::string last = read_bytes(folder / "checkpoint.h5");
  EXPECT_TRUE(std::filesystem::exists(folder / "checkpoint_previous.h5"));
  simulation.advance(100);
  const std::string expected = snapshot_bytes(simulation, folder);

  std::string flipped = last;
  flipped[flipped.size() / 2] ^= 0x10;
  for (const std::string& bytes :
       {std::string(), last.substr(0, last.size() / 2), last.substr(0, last.size() - 7), flipped}) {
    write_bytes(folder / "checkpoint.h5", bytes);
    Simulation resumed(mixed_scene());
    resumed.read_checkpoint(folder.path());
    EXPECT_TRUE(resumed.step() == 300 || (bytes == flipped && resumed.step() == 600));
    resumed.advance(700 - resumed.step());
    EXPECT_EQ(snapshot_bytes(resumed, folder), expected);
  }
  std::filesystem::remove(folder / "checkpoint.h5");  // stopped between the two renames
  Simulation resumed(mixed_scene());
  resumed.read_checkpoint(folder.path());
  EXPECT_EQ(resumed.step(), 300);
}

TEST(Checkpoint, RefusesWhatItCannotUse) {
  const TemporaryFolder folder;
  Simulation simulation(mixed_scene());
  const auto resume = [&] { return refusal([&] { Simulation(mixed_scene()).read_checkpoint(folder.path()); }); };
  EXPECT_NE(resume().find("checkpoint.h5"), std::string::npos) << "none there: " << resume();
  simulation.advance(100);
  simulation.write_checkpoint(folder.path());
  const std::string whole = read_bytes(folder / "checkpoint.h5");
  for (const std::string& bytes :
       {std::string(), std::string("text"), whole.substr(0, 100), whole.substr(0, whole.size() - 1)}) {
    write_bytes(folder / "checkpoint.h5", bytes);
    EXPECT_NE(resume().find("checkpoint.h5"), std::string::npos) << resume();
  }
  // Of another version, with nothing of today's in it: by its number, and no reason to go back to an earlier one.
  write_bytes(folder / "checkpoint_previous.h5", whole);
  for (const int version : {1, 4, 99}) {
    {
      dem_gpu::io::Hdf5Writer other(folder / "checkpoint.h5", "talus-checkpoint", version);
      other.commit();
    }
    EXPECT_NE(
        resume().find("is of checkpoint version " + std::to_string(version) + ", this program resumes from version "),
        std::string::npos)
        << resume();
  }
  std::filesystem::remove(folder / "checkpoint_previous.h5");
  dem_gpu::write_snapshot(folder / "checkpoint.h5", simulation.snapshot());
  EXPECT_NE(resume(), "accepted") << "a snapshot is no checkpoint";
}

TEST(Checkpoint, RefusesAnotherPrecisionByName) {
  const TemporaryFolder folder;
  const bool is_mixed = sizeof(dem_gpu::LocalReal) == sizeof(float);
  Simulation simulation(mixed_scene());
  std::string refusals;
  for (int version = 1; version < 50; ++version) {  // one of them is today's
    dem_gpu::io::Hdf5Writer other(folder / "checkpoint.h5", "talus-checkpoint", version);
    other.write_attribute("local_real_bytes", static_cast<std::int64_t>(is_mixed ? sizeof(double) : sizeof(float)));
    other.commit();
    refusals += refusal([&] { simulation.read_checkpoint(folder.path()); }) + "\n";
  }
  EXPECT_NE(refusals.find(is_mixed ? "written in double precision, this build computes in mixed precision"
                                   : "written in mixed precision, this build computes in double precision"),
            std::string::npos)
      << refusals;
}

TEST(Checkpoint, RefusesAnotherScene) {
  const TemporaryFolder folder;
  Simulation simulation(mixed_scene());
  simulation.advance(100);
  simulation.write_checkpoint(folder.path());
  struct Change {
    const char* name;
    std::function<void(Scene&)> make;
  };
  const Change changes[] = {
      {"a body less", [](Scene& s) { s.bodies.pop_back(); }},
      {"another size", [](Scene& s) { s.bodies[0].scale = 1.1; }},
      {"another radius at equal mass",
       [](Scene& s) {
         s.shapes[2] = dem_gpu::sphere_shape("ball", 0.004);
         s.materials[1].density *= 8;
       }},
      {"another material", [](Scene& s) { s.contact[0][0].friction_coefficient = 0.1; }},
      {"another restitution", [](Scene& s) { s.contact[0][0].restitution = 0.9; }},
      {"no friction",
       [](Scene& s) {
         s.friction.reset();
         s.contact[1][1].rolling_friction = 0;
       }},
      {"another tangential stiffness", [](Scene& s) { s.friction->tangential_stiffness_ratio = 0.5; }},
      {"no ledger", [](Scene& s) { s.energy_ledger = false; }},
      {"another gravity", [](Scene& s) { s.gravity.z = -1; }},
      {"another step", [](Scene& s) { s.run.time_step = 5e-6; }},
      {"a wall less", [](Scene& s) { s.walls.pop_back(); }},
      {"a wider drum", [](Scene& s) { std::get<dem_gpu::Cylinder>(s.walls[0].geometry).radius = 0.11; }},
      {"a plane elsewhere", [](Scene& s) { std::get<dem_gpu::Plane>(s.walls[3].geometry).point.y = -0.05; }},
      {"another lifter",
       [](Scene& s) {
         s.walls[1].geometry =
             dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.02, 0.08, 0.021}), {}, {0, 0, -0.092})};
       }},
      {"a faster drum", [](Scene& s) { s.walls[0].motion.angular_velocity.y = 9; }},
      {"a later gate", [](Scene& s) { s.walls[2].removed_at = 0.05; }},
      {"another outflow", [](Scene& s) { s.outflow->height = -0.07; }},
      {"another stiffness", [](Scene& s) { s.polyhedral_law = dem_gpu::DepthPotential{1.1e8}; }},
      {"another cap",
       [](Scene& s) {
         s.polyhedral_law = dem_gpu::DepthPotential{1e8, 0.2};
       }},
      {"another law", [](Scene& s) { s.polyhedral_law = dem_gpu::OverlapVolume{1e8}; }},
      {"another sphere stiffness", [](Scene& s) { s.sphere_law = dem_gpu::LinearSpring{3e4}; }},
  };
  for (const Change& change : changes) {
    Scene scene = mixed_scene();
    change.make(scene);
    Simulation other(scene);
    const std::string message = refusal([&] { other.read_checkpoint(folder.path()); });
    EXPECT_NE(message.find("another scene"), std::string::npos) << change.name << ": " << message;
  }
  EXPECT_EQ(refusal([&] { Simulation(mixed_scene()).read_checkpoint(folder.path()); }), "accepted");
}

TEST(Checkpoint, FallsBackOnDamageOnlyAndTells) {
  const TemporaryFolder folder;
  Simulation simulation(mixed_scene());
  simulation.advance(100);
  simulation.write_checkpoint(folder.path());
  Scene other_scene = mixed_scene();
  other_scene.gravity.z = -1;
  Simulation other(other_scene);
  other.write_checkpoint(folder.path());
  // The previous one would fit, but the last is whole and another scene's.
  const std::string message = refusal([&] { Simulation(mixed_scene()).read_checkpoint(folder.path()); });
  EXPECT_NE(message.find("another scene"), std::string::npos) << message;
  EXPECT_EQ(Simulation(other_scene).read_checkpoint(folder.path()), "");
  write_bytes(folder / "checkpoint.h5", "text");
  Simulation resumed(mixed_scene());
  const std::string note = resumed.read_checkpoint(folder.path());
  EXPECT_EQ(note.rfind("checkpoint.h5 is damaged (", 0), 0u) << note;
  EXPECT_NE(note.find("went on from checkpoint_previous.h5"), std::string::npos) << note;
  EXPECT_EQ(resumed.step(), 100);
}

}  // namespace
