// SPDX-License-Identifier: GPL-3.0-or-later
// talus-decompose on a folder of scans, as a user starts it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "catalog/shape_catalog.h"
#include "shape_pipeline/mesh_file.h"
#include "tests/support/solids.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tool_run.h"

namespace {

using nlohmann::json;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using test_support::write_bytes;

int decompose(const TemporaryFolder& folder, const std::string& arguments) {
  return test_support::run(folder, "'" TALUS_DECOMPOSE "' " + arguments).status;
}

json output(const TemporaryFolder& folder) { return json::parse(read_bytes(folder / "out")); }

std::string reason_of(const json& result, const std::string& shape) {
  for (const json& failure : result["failures"])
    if (failure["shape"] == shape) return failure["reason"];
  return "";
}

catalog::TriangleMesh egg(double length) { return solids::scaled(solids::sphere(1, 3), {length, 1, 1}); }

/// Three sound scans, and every kind of file that no shape can be made of.
void write_scans(const TemporaryFolder& folder) {
  std::filesystem::create_directory(folder / "scans");
  const auto write = [&](const std::string& name, const catalog::TriangleMesh& mesh) {
    shape_pipeline::write_stl(folder / "scans" / name, mesh);
  };
  write("angle.stl", solids::l_shape());
  write("egg.stl", egg(1.5));
  write("long_egg.stl", egg(2.5));
  write("bad_flat.stl", solids::scaled(egg(1.5), {1, 1, 0}));
  catalog::TriangleMesh three_faces = solids::box({0, 0, 0}, {1, 1, 1});
  three_faces.faces.resize(3);
  write("bad_open.stl", three_faces);
  catalog::TriangleMesh not_a_number = egg(1.5);
  not_a_number.vertices[7][1] = std::numeric_limits<double>::quiet_NaN();
  write("bad_nan.stl", not_a_number);
  write("bad_huge.stl", solids::scaled(egg(1.5), {1e30, 1e30, 1e30}));
  write("bad_tiny.stl", solids::scaled(egg(1.5), {1e-30, 1e-30, 1e-30}));
  write_bytes(folder / "scans/bad_empty.stl", "");
  write_bytes(folder / "scans/bad_short.stl", read_bytes(folder / "scans/egg.stl").substr(0, 500));
}

TEST(DecomposeFolder, GoesOnPastBadScansAndGivesTheSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  write_scans(folder);
  const std::string options = " --unit mm --parts 1,2 --effort 0.1 --json";
  ASSERT_EQ(decompose(folder, "scans --into one.talus --threads 1" + options), 3);
  const json one = output(folder);
  EXPECT_EQ(one["levels"].size(), 6u) << one.dump(1);
  EXPECT_EQ(one["failures"].size(), 7u);
  for (const std::string name : {"bad_flat", "bad_open", "bad_nan", "bad_huge", "bad_tiny", "bad_empty", "bad_short"}) {
    const std::string reason = reason_of(one, name);
    EXPECT_NE(reason.find("scans/" + name + ".stl: "), std::string::npos) << name << ": " << reason;
    EXPECT_NE(reason.find("; "), std::string::npos) << "no remedy: " << reason;
    EXPECT_NE(read_bytes(folder / "err").find(name + ": not decomposed: "), std::string::npos) << "listed at the end";
  }
  EXPECT_NE(read_bytes(folder / "err").find("decompose: [3/3] long_egg"), std::string::npos) << "progress";
  for (const std::string threads : {"2", "5"}) {
    ASSERT_EQ(decompose(folder, "scans --into many.talus --threads " + threads + options), 3);
    EXPECT_TRUE(read_bytes(folder / "one.talus") == read_bytes(folder / "many.talus")) << threads << " threads";
    std::filesystem::remove(folder / "many.talus");
  }
}

TEST(DecomposeFolder, AnOptionThatIsNoNumberIsAUsageError) {
  const TemporaryFolder folder;
  for (const char* option : {"--effort nan", "--effort inf", "--time-budget nan", "--effort much"})
    EXPECT_EQ(decompose(folder, std::string("ore.talus ") + option), 2) << option;
}

/// What a command line is refused with; empty if it is not a usage error.
std::string usage_error(const TemporaryFolder& folder, const std::string& arguments) {
  return decompose(folder, arguments) == 2 ? read_bytes(folder / "err") : "";
}

TEST(DecomposeFolder, AnOptionIsRefusedWithWhatIsAllowedAndWhatWasFound) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& option, const std::string& message) {
    EXPECT_EQ(usage_error(folder, "ore.talus " + option),
              "talus decompose: usage: " + message + "; see talus decompose --help\n");
  };
  expect("--mode foo", "--mode: expected volume-true, enclosing or inscribed, found 'foo'");
  expect("--mode 1", "--mode: expected volume-true, enclosing or inscribed, found '1'");
  expect("--bodies foo", "--bodies: expected join, largest or refuse, found 'foo'");
  expect("--seed -1", "--seed: expected a whole number from 0 to 18446744073709551615, found '-1'");
  expect("--seed 1.5", "--seed: expected a whole number from 0 to 18446744073709551615, found '1.5'");
  const std::string parts = "--parts: expected whole numbers from 1 to 256 with commas between them, found '";
  for (const std::string list : {"1,,2", "1,2,", ",1", "0", "257", "1x", "1.5"})
    expect("--parts " + list, parts + list + "'");
  expect("--vertices 16,65", "--vertices: expected whole numbers from 8 to 64 with commas between them, found '16,65'");
  expect("--effort inf", "--effort: expected a number from 0.1 to 100, found 'inf'");
  expect("--smallest-volume 1", "--smallest-volume: expected a number from 0 to below 1, found '1'");
  expect("--faces 0x18", "--faces: expected 8 to 124 faces, or 0 for no cap, found '0x18'");
  expect("--faces 5", "--faces: expected 8 to 124 faces, or 0 for no cap, found '5'");
  EXPECT_EQ(usage_error(folder, "ore.talus --genus 0"),
            "talus decompose: usage: --genus is for scans; add --into ore.talus\n");
}

TEST(DecomposeFolder, TheTableTellsModesAndCapsOfFacesWhereThereAreAny) {
  const TemporaryFolder folder;
  shape_pipeline::write_stl(folder / "box.stl", solids::box({0, 0, 0}, {1, 2, 3}));
  const auto header = [&](const std::string& arguments) {
    EXPECT_EQ(decompose(folder, arguments), 0) << read_bytes(folder / "err");
    const std::string table = read_bytes(folder / "out");
    return table.substr(0, table.find('\n'));
  };
  const std::string plain = header("box.stl --into ore.talus --unit mm --parts 1");
  EXPECT_TRUE(plain.starts_with("shape  asked    cap  parts  vertices")) << plain;
  const std::string capped = header("ore.talus --parts 1 --mode enclosing --faces 24");
  EXPECT_TRUE(capped.starts_with("shape  mode         asked    cap  faces<=  parts")) << capped;
  EXPECT_NE(read_bytes(folder / "out").find("\nbox    enclosing        1     32       24      1  "), std::string::npos)
      << read_bytes(folder / "out");
  ASSERT_EQ(decompose(folder, "ore.talus --parts 1 --mode enclosing --faces 24 --json"), 0);
  EXPECT_EQ(output(folder)["levels"][0]["mode"], "enclosing");
  EXPECT_EQ(output(folder)["levels"][0]["face_cap"], 24);
}

TEST(DecomposeFolder, SeveralBodiesOfAScanAreJoinedOrOneIsKeptOrAllRefused) {
  const TemporaryFolder folder;
  shape_pipeline::write_stl(folder / "pair.stl",
                            solids::together({solids::box({0, 0, 0}, {2, 2, 2}), solids::box({3, 0, 0}, {4, 1, 1})}));
  const std::string command = "pair.stl --into ore.talus --unit m --parts 2,2 --json";
  EXPECT_EQ(decompose(folder, command), 3);
  const std::string reason = reason_of(output(folder), "pair");
  EXPECT_NE(reason.find("2 separate bodies"), std::string::npos) << reason;
  EXPECT_NE(reason.find("--bodies join"), std::string::npos) << reason;
  const auto volume = [&](const std::string& bodies) {
    EXPECT_EQ(decompose(folder, command + " --bodies " + bodies), 0) << read_bytes(folder / "err");
    const json levels = output(folder)["levels"];
    EXPECT_EQ(levels.size(), 1u) << "a number of parts given twice is one level";
    EXPECT_LT(levels[0]["symmetric_difference"], 1e-9);
    const catalog::ShapeCatalog shapes(folder / "ore.talus", catalog::ShapeCatalog::Access::read_only);
    return shapes.shape(*shapes.find("pair")).mass_properties.volume;
  };
  EXPECT_NEAR(volume("join"), 9, 1e-12);
  EXPECT_NEAR(volume("largest"), 8, 1e-12);
}

TEST(DecomposeFolder, ASecondRunDoesWhatIsNew) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scans");
  shape_pipeline::write_stl(folder / "scans/egg.stl", egg(1.5));
  const std::string command = "scans --into ore.talus --unit mm --parts 1 --effort 0.1 --json";
  ASSERT_EQ(decompose(folder, command), 0);
  shape_pipeline::write_stl(folder / "scans/angle.stl", solids::l_shape());
  ASSERT_EQ(decompose(folder, command), 0);
  const json levels = output(folder)["levels"];
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_TRUE(levels[0]["new"]) << "angle";
  EXPECT_FALSE(levels[1]["new"]) << "egg";
  EXPECT_NE(read_bytes(folder / "err").find("decompose: [1/1] angle"), std::string::npos);
}

TEST(DecomposeFolder, AShapeWithACheckThatDidNotPassIsDecomposedAndTheStatusIs4) {
  const TemporaryFolder folder;
  // Normals that all point up are none of an ellipsoid's: the check given_normals.
  std::string cloud;
  constexpr int kPoints = 1500;
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1 - (2 * i + 1.0) / kPoints, radius = std::sqrt(1 - z * z), angle = 2.399963 * i;  // golden angle
    cloud += std::to_string(1.5 * radius * std::cos(angle)) + " " + std::to_string(radius * std::sin(angle)) + " " +
             std::to_string(z) + " 0 0 1\n";
  }
  write_bytes(folder / "cloud.xyz", cloud);
  EXPECT_EQ(decompose(folder, "cloud.xyz --into ore.talus --unit mm --parts 1 --effort 0.1 --json"), 4);
  EXPECT_EQ(output(folder)["levels"].size(), 1u);
  EXPECT_NE(read_bytes(folder / "err").find("  cloud: given_normals\n"), std::string::npos)
      << read_bytes(folder / "err");
  EXPECT_EQ(decompose(folder, "ore.talus --parts 1 --effort 0.1 --json"), 0) << "nothing is digitised";
}

TEST(DecomposeFolder, AFolderIsNoCatalogueAndOptionsOfScansNeedOne) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scans");
  EXPECT_EQ(decompose(folder, "scans"), 3);
  EXPECT_NE(read_bytes(folder / "err").find("--into ore.talus --unit mm"), std::string::npos);
  EXPECT_EQ(decompose(folder, "scans --into ore.talus --unit mm"), 3);
  EXPECT_NE(read_bytes(folder / "err").find("no scan files in this folder"), std::string::npos);
  EXPECT_EQ(decompose(folder, "scans --into ore.talus"), 2) << "no unit is guessed";
  EXPECT_EQ(decompose(folder, "ore.talus --unit mm"), 2);
  EXPECT_EQ(decompose(folder, "a.talus b.talus"), 2);
  EXPECT_EQ(decompose(folder, "scans --into ore.talus --unit mm --select \"volume > 1\""), 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "ore.talus"));
}

}  // namespace
