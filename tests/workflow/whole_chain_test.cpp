// SPDX-License-Identifier: GPL-3.0-or-later
// The whole of Talus on two tiny scans: digitise, decompose, query, simulate, post-process, each as its own program.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "catalog/mass_properties.h"
#include "catalog/shape_catalog.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::read_bytes;
using test_support::TemporaryFolder;

/// Runs `talus ARGUMENTS` in a folder; standard output goes to `out.txt` there, standard error to `error.txt`.
int run_talus(const fs::path& folder, const std::string& arguments) {
  const std::string command =
      "cd '" + folder.string() + "' && '" TALUS_EXECUTABLE "' " + arguments + " > out.txt 2> error.txt";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

constexpr char kScene[] = R"(name = "tiny"
[run]
end_time = "60 ms"
snapshot_every = "20 ms"
series_every = "5 ms"
[material.rock]
density = "2700 kg/m3"
[contact.default]
restitution = 0.4
friction = 0.5
[contact_law]
polyhedra = "depth_potential"
largest_overlap = "3 %"
at_speed = "1 m/s"
[[fill]]
shapes_from = "ore.talus"
select = "name like 'rock%'"
parts = 2
vertices = 16
material = "rock"
count = 8
where = {box = {min = [0, 0, "5 mm"], max = ["0.12 m", "0.12 m", "0.13 m"]}}
[fill.size]
kind = "single"
basis = "mass"
definition = "sieve"
size = "20 mm"
[[wall]]
name = "floor"
type = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
material = "rock"
)";

TEST(WholeChain, FromTwoScansToAReport) {
  const TemporaryFolder folder;
  const fs::path here = folder.path();
  ASSERT_EQ(run_talus(here, "digitize --make-virtual-scans scans --count 2 --seed 3"), 0)
      << read_bytes(here / "error.txt");
  ASSERT_EQ(run_talus(here, "digitize scans --into ore.talus --unit m --truth scans/truth.json"), 0)
      << read_bytes(here / "error.txt");
  ASSERT_EQ(run_talus(here, "decompose ore.talus --parts 1,2 --vertices 16"), 0) << read_bytes(here / "error.txt");

  double density_volume = 0;
  {
    const catalog::ShapeCatalog ore(here / "ore.talus", catalog::ShapeCatalog::Access::read_only);
    const auto shapes = ore.select("name like 'rock%'");
    ASSERT_EQ(shapes.size(), 2u);
    for (const catalog::ShapeId id : shapes) {
      const catalog::ShapeRecord shape = ore.shape(id);
      const catalog::LevelOfDetail level = ore.level(id, {2, 16});
      EXPECT_EQ(level.parts.size(), 2u);
      EXPECT_NEAR(level.mass_properties.volume / shape.mass_properties.volume, 1, 2e-3);
      EXPECT_LT(level.error.symmetric_difference, 0.2);
      density_volume += shape.mass_properties.volume;
    }
  }
  EXPECT_GT(density_volume, 0);

  std::ofstream(here / "tiny.toml") << kScene;
  ASSERT_EQ(run_talus(here, "simulate tiny.toml --out run"), 0) << read_bytes(here / "error.txt");
  const json run = json::parse(read_bytes(here / "run/run.json"));
  EXPECT_TRUE(run.at("finished").get<bool>());
  EXPECT_LT(std::abs(run.at("energy").at("imbalance_share").get<double>()), 0.02);

  ASSERT_EQ(run_talus(here, "post run --no-pictures"), 0) << read_bytes(here / "error.txt");
  EXPECT_TRUE(fs::exists(here / "run/post/bodies.pvd"));
  const std::string report = read_bytes(here / "run/report.html");
  EXPECT_NE(report.find("tiny"), std::string::npos);
  EXPECT_NE(report.find("</html>"), std::string::npos);

  // Again: nothing is digitised or decomposed anew, and the catalogue keeps its bytes.
  const std::string before = catalog::sha256_of_file(here / "ore.talus");
  ASSERT_EQ(run_talus(here, "digitize scans --into ore.talus --unit m --truth scans/truth.json"), 0);
  ASSERT_EQ(run_talus(here, "decompose ore.talus --parts 1,2 --vertices 16"), 0);
  EXPECT_EQ(catalog::sha256_of_file(here / "ore.talus"), before);
}

}  // namespace
