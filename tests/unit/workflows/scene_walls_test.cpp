// SPDX-License-Identifier: Apache-2.0
// Walls, lifters, gates and meshes of a scene file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "catalog/mass_properties.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/workflows/read_scene.h"

namespace workflows {
namespace {

using test_support::drum_scene;
using test_support::with;

constexpr double kPi = std::numbers::pi;

TEST(SceneWalls, LiftersRiseFromTheShellAndTurnWithIt) {
  const dem_gpu::Scene scene =
      read(with(drum_scene(), "height = \"10 mm\"", "height = \"10 mm\"\nface_angle = \"70 deg\"")).scene;
  for (int i = 0; i < 6; ++i) {
    const dem_gpu::Wall& lifter = scene.walls[static_cast<std::size_t>(1 + i)];
    EXPECT_EQ(lifter.name, "lifter_0" + std::to_string(i));
    EXPECT_EQ(lifter.contact_class, "lifter");
    EXPECT_EQ(lifter.material, 1);
    EXPECT_EQ(lifter.motion.angular_velocity, scene.walls[0].motion.angular_velocity);
    const auto& part = std::get<dem_gpu::VolumeObject>(lifter.geometry).part;
    ASSERT_EQ(part.vertex_count(), 8u);
    int behind_shell = 0, at_top = 0;
    double top_width = 0;
    for (const catalog::Point& p : part.vertices) {
      // The shell's axis is y; the lifter's direction is read off its own centre.
      const catalog::Point centre = mass_properties(volume_moments(triangulated(part))).centroid;
      const double length = std::hypot(centre[0], centre[2]);
      const double out = (p[0] * centre[0] + p[2] * centre[2]) / length;
      const double side = (p[0] * centre[2] - p[2] * centre[0]) / length;
      if (std::hypot(p[0], p[2]) > 0.1) ++behind_shell;
      if (std::abs(out - 0.09) < 1e-12) ++at_top, top_width = std::max(top_width, 2 * std::abs(side));
      EXPECT_GE(std::abs(p[1]), 0.05);  // past both ends of the shell
    }
    EXPECT_EQ(behind_shell, 4);
    EXPECT_EQ(at_top, 4);
    EXPECT_NEAR(top_width, 0.02 - 2 * 0.01 / std::tan(70 * kPi / 180), 1e-12);
  }
}

TEST(SceneWalls, LiftersStandEvenlyAroundTheAxis) {
  const dem_gpu::Scene scene = read(drum_scene()).scene;
  const auto centre = [&](std::size_t lifter) {
    return mass_properties(
               volume_moments(triangulated(std::get<dem_gpu::VolumeObject>(scene.walls[1 + lifter].geometry).part)))
        .centroid;
  };
  for (std::size_t i = 0; i < 6; ++i) {
    const catalog::Point a = centre(i), b = centre((i + 1) % 6);
    const double cosine = (a[0] * b[0] + a[2] * b[2]) / (std::hypot(a[0], a[2]) * std::hypot(b[0], b[2]));
    EXPECT_NEAR(cosine, std::cos(2 * kPi / 6), 1e-12);
  }
}

/// A tetrahedron as text, in millimetres; `normals_out` or turned round.
std::string tetrahedron_stl(bool normals_out) {
  const std::string corner[] = {"vertex 0 0 0\n", "vertex 10 0 0\n", "vertex 0 10 0\n", "vertex 0 0 10\n"};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string text = "solid t\n";
  for (const auto& f : faces)
    text += "facet normal 0 0 0\nouter loop\n" + corner[f[0]] + corner[f[normals_out ? 1 : 2]] +
            corner[f[normals_out ? 2 : 1]] + "endloop\nendfacet\n";
  return text + "endsolid t\n";
}

TEST(SceneWalls, MeshWallsComeFromStlFiles) {
  const test_support::TemporaryFolder folder;
  const auto scene_with = [&](const std::string& stl, const std::string& more) {
    test_support::write_bytes(folder / "t.stl", stl);
    const std::string text = drum_scene() +
                             "\n[[wall]]\nname = \"t\"\ntype = \"mesh\"\nfile = \"t.stl\"\nunit = \"mm\"\nmaterial = "
                             "\"steel\"\n" +
                             more;
    return read_scene_text(text, "scene.toml", folder.path()).scene;
  };
  const auto refusal_with = [&](const std::string& stl, const std::string& more) -> std::string {
    try {
      scene_with(stl, more);
    } catch (const catalog::InputError& error) {
      return error.what();
    }
    return "not refused";
  };
  const dem_gpu::Scene scene =
      scene_with(tetrahedron_stl(true), "motion = {oscillate = [0, 0, \"1 mm\"], frequency = \"20 Hz\"}\n");
  const auto wall =
      std::find_if(scene.walls.begin(), scene.walls.end(), [](const dem_gpu::Wall& one) { return one.name == "t"; });
  ASSERT_NE(wall, scene.walls.end());
  const auto& mesh = std::get<dem_gpu::MeshObject>(wall->geometry).mesh;
  EXPECT_EQ(mesh.vertices.size(), 4u) << "corners at one place are one vertex";
  EXPECT_DOUBLE_EQ(mesh.vertices[1][1], 0.01);
  EXPECT_DOUBLE_EQ(wall->motion.amplitude.z, 1e-3);
  EXPECT_NEAR(wall->motion.frequency, 20, 1e-12);
  EXPECT_NE(refusal_with(tetrahedron_stl(false), "").find("inverted"), std::string::npos);
  EXPECT_EQ(refusal_with(tetrahedron_stl(false), "bodies = \"inside\"\n"), "not refused");
  EXPECT_NE(refusal_with("solid t\nfacet normal 0 0 1\n", "").find("ends before endsolid"), std::string::npos);
  EXPECT_NE(refusal_with("junk", "").find("expected an STL file"), std::string::npos);
}

TEST(SceneWalls, ReadsEveryWallTypeGatesAndOutflow) {
  const std::string walls = R"(
[[wall]]
name = "floor"
type = "plane"
point = [0, 0, -1]
normal = [0, 0, 2]
material = "steel"
[[wall]]
name = "gate"
type = "disc"
centre = [0, 0, 0]
normal = [0, 0, 1]
radius = "8 cm"
material = "steel"
open_at = "1.2 s"
motion = {translate = [0, 0, "-10 mm/s"], start = "1 s", ramp = "0.1 s"}
[[wall]]
name = "cone"
type = "cone"
base = [0, 0, 0]
axis = [0, 0, 1]
length = 0.3
base_radius = 0.08
top_radius = 0.2
material = "steel"
class = "shell"
[[wall]]
name = "bar"
type = "block"
size = [2, 0.2, 0.1]
centre = [5, 5, 5]
rotation = {axis = [0, 0, 1], angle = "90 deg"}
material = "steel"
[[wall]]
name = "wedge"
type = "polyhedron"
vertices = [[9, 0, 0], [10, 0, 0], [9, 1, 0], [9, 0, 1]]
material = "steel"
[outflow]
height = "-5 cm"
)";
  const dem_gpu::Scene scene = read(drum_scene() + walls).scene;
  ASSERT_EQ(scene.walls.size(), 12u);
  EXPECT_EQ(std::get<dem_gpu::Plane>(scene.walls[1].geometry).normal, (dem_gpu::Vec3{0, 0, 1}));
  EXPECT_DOUBLE_EQ(*scene.walls[2].removed_at, 1.2);
  EXPECT_DOUBLE_EQ(scene.walls[2].motion.velocity.z, -0.01);
  EXPECT_DOUBLE_EQ(scene.walls[2].motion.ramp_time, 0.1);
  EXPECT_DOUBLE_EQ(std::get<dem_gpu::Cone>(scene.walls[3].geometry).top_radius, 0.2);
  EXPECT_EQ(scene.walls[3].contact_class, "shell");
  const auto bar = triangulated(std::get<dem_gpu::VolumeObject>(scene.walls[4].geometry).part);
  EXPECT_NEAR(volume_moments(bar).volume, 2 * 0.2 * 0.1, 1e-12);
  for (const catalog::Point& p : bar.vertices) {
    EXPECT_NEAR(std::abs(p[0] - 5), 0.1, 1e-12);
    EXPECT_NEAR(std::abs(p[1] - 5), 1, 1e-12);
  }
  EXPECT_NEAR(volume_moments(triangulated(std::get<dem_gpu::VolumeObject>(scene.walls[5].geometry).part)).volume,
              1.0 / 6, 1e-12);
  EXPECT_DOUBLE_EQ(scene.outflow->height, -0.05);
}

TEST(SceneWalls, RefusesWallsOfOneName) {
  const std::string text = drum_scene() +
                           "[[wall]]\nname = \"shell\"\ntype = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n"
                           "material = \"steel\"\n";
  EXPECT_NE(refusal(text).find("two walls are named \"shell\""), std::string::npos) << refusal(text);
  // At the second one's name: the fourth line from the end.
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_NE(refusal(text).find(":" + std::to_string(lines - 4) + ":"), std::string::npos) << refusal(text);
}

}  // namespace
}  // namespace workflows
