// SPDX-License-Identifier: Apache-2.0
// The front command and talus-catalog as a user starts them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "catalog/shape_catalog.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace test_support;
namespace fs = std::filesystem;

struct Outcome {
  int status = -1;
  std::string out, err;
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Outcome run(const fs::path& command, const std::string& arguments, const TemporaryFolder& folder) {
  std::string line;
  line.append("'").append(command.string()).append("' ").append(arguments);
  line.append(" >'").append((folder / "out").string()).append("' 2>'").append((folder / "err").string()).append("'");
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder / "out"), text_of(folder / "err")};
}

Outcome talus(const std::string& arguments, const TemporaryFolder& folder) {
  return run(TALUS_EXECUTABLE, arguments, folder);
}

/// A copy of the front command in a folder of its own, with stages that are scripts.
class FrontCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file(TALUS_EXECUTABLE, folder_ / "talus");
    write_script("talus-post", "#!/bin/sh\necho \"$0\"\nfor a in \"$@\"; do echo \"<$a>\"; done\nexit 75\n");
  }
  void write_script(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    fs::permissions(folder_ / name, fs::perms(0755));
  }
  Outcome start(const std::string& arguments) { return run(folder_ / "talus", arguments, folder_); }

  TemporaryFolder folder_;
};

TEST_F(FrontCommand, StartsTheStageBesideItselfWithItsArguments) {
  const Outcome outcome = start("post 'two words' --x=1 \"\"");
  EXPECT_EQ(outcome.status, 75) << "the stage's status is the command's";
  EXPECT_EQ(outcome.out, (folder_ / "talus-post").string() + "\n<two words>\n<--x=1>\n<>\n");
}

TEST_F(FrontCommand, IsFoundThroughALink) {
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink(folder_ / "talus", folder_ / "elsewhere/talus");
  EXPECT_EQ(run(folder_ / "elsewhere/talus", "post", folder_).status, 75);
}

TEST_F(FrontCommand, HelpAndVersion) {
  const Outcome help = start("--help");
  EXPECT_EQ(help.status, 0);
  EXPECT_TRUE(help.out.starts_with("Example: "));
  for (const char* stage : {"digitize", "decompose", "catalog", "simulate", "post", "bench"})
    EXPECT_NE(help.out.find(std::string("\n  ") + stage + " "), std::string::npos) << stage;
  EXPECT_EQ(start("--version").out, std::string("talus ") + TALUS_VERSION + "\n");
  const Outcome bare = start("");
  EXPECT_EQ(bare.status, 2);
  EXPECT_EQ(bare.out, "");
  EXPECT_EQ(bare.err, help.out);
}

TEST_F(FrontCommand, UnknownAndUnbuiltStages) {
  const Outcome unknown = start("simulat scene.toml");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("did you mean 'simulate'"), std::string::npos) << unknown.err;
  const Outcome unbuilt = start("simulate scene.toml");
  EXPECT_EQ(unbuilt.status, 2);
  EXPECT_NE(unbuilt.err.find("is not built"), std::string::npos) << unbuilt.err;
  EXPECT_NE(start("--help").out.find("run a scene (not built)"), std::string::npos);
  EXPECT_EQ(start("../post").status, 2);
}

TEST_F(FrontCommand, AStageThatCannotRunIsAFailure) {
  write_script("talus-bench", "#!/no/such/interpreter\n");
  const Outcome outcome = start("bench");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("cannot be started"), std::string::npos) << outcome.err;
}

/// Shapes rock_1 to rock_3 of scale 1 to 3, rock_2 with levels of 1 and 4 parts; one rejected input.
class CatalogCommand : public testing::Test {
 protected:
  void SetUp() override {
    catalog::ShapeCatalog catalog(folder_ / "ore.talus", catalog::ShapeCatalog::Access::read_write);
    for (const int scale : {1, 2, 3}) {
      const catalog::ShapeRecord shape = sample_shape("rock_" + std::to_string(scale), scale);
      const catalog::ShapeId id = catalog.store_shape(shape);
      if (scale == 2) catalog.store_levels(id, {sample_level(shape, 1), sample_level(shape, 4)});
    }
    catalog.store_rejected({"flat", "flat.ply", std::string(64, 'c'), "all points in one plane"});
  }
  Outcome start(const std::string& action, const std::string& arguments = "") {
    return talus("catalog " + action + " '" + (folder_ / "ore.talus").string() + "' " + arguments, folder_);
  }
  nlohmann::json json(const std::string& action, const std::string& arguments = "") {
    const Outcome outcome = start(action, arguments + " --json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }

  TemporaryFolder folder_;
};

TEST_F(CatalogCommand, List) {
  const Outcome outcome = start("list");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 4);
  const nlohmann::json shapes = json("list")["shapes"];
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_NEAR(shapes[1]["volume"].get<double>(), 8 * 2.4e-9, 1e-20);
  // d^3 pi / 6 = V
  EXPECT_NEAR(std::pow(shapes[1]["equivalent_diameter"].get<double>(), 3) * M_PI / 6, 8 * 2.4e-9, 1e-20);
  EXPECT_EQ(shapes[1]["levels"].size(), 2u);
  EXPECT_EQ(shapes[0]["failed_checks"][0], "volume_second_method");
  EXPECT_EQ(shapes[0]["grade"], 3);
  EXPECT_EQ(json("list", "--select 'volume > 3e-8'")["shapes"].size(), 1u);
}

TEST_F(CatalogCommand, Show) {
  const Outcome outcome = start("show", "rock_2");
  EXPECT_EQ(outcome.status, 0);
  for (const char* expected :
       {"rock_2.ply", "talus 0.1.0", "volume_second_method", "FAILED", "sphericity_wadell", "19.2 mm3"})
    EXPECT_NE(outcome.out.find(expected), std::string::npos) << expected;
  const nlohmann::json shape = json("show", "rock_2")["shape"];
  EXPECT_EQ(shape["provenance"]["source_sha256"], std::string(64, 'a'));
  EXPECT_EQ(shape["checks"].size(), 2u);
  EXPECT_EQ(shape["levels"][1]["error"]["volume_error"], -0.003);
  EXPECT_EQ(shape["levels"][1]["error"]["surface_from_union"]["percentile_95"], 3e-3);
  EXPECT_EQ(shape["levels"][1]["mode"], "volume-true");
  EXPECT_EQ(shape["levels"][1]["face_cap"], 0);
}

TEST_F(CatalogCommand, UnknownNames) {
  const Outcome unknown = start("show", "rock2");
  EXPECT_EQ(unknown.status, 3);
  EXPECT_NE(unknown.err.find("did you mean 'rock_2'"), std::string::npos) << unknown.err;
  const Outcome rejected = start("show", "flat");
  EXPECT_EQ(rejected.status, 3);
  EXPECT_NE(rejected.err.find("was rejected: all points in one plane"), std::string::npos) << rejected.err;
}

TEST_F(CatalogCommand, Query) {
  EXPECT_EQ(start("query", "'volume > 1e-8 and not name like \"%3\"'").out, "rock_2\n");
  EXPECT_EQ(json("query", "'volume > 1e-8'")["shapes"][1]["name"], "rock_3");
  const Outcome bad = start("query", "'volum > 1'");
  EXPECT_EQ(bad.status, 3);
  EXPECT_EQ(bad.out, "");
  EXPECT_NE(bad.err.find("did you mean 'volume'"), std::string::npos) << bad.err;
  EXPECT_EQ(start("query").status, 2);
}

TEST_F(CatalogCommand, Sample) {
  const Outcome once = start("sample", "--count 50 --seed 9"), again = start("sample", "--count 50 --seed 9");
  EXPECT_EQ(once.status, 0);
  EXPECT_EQ(std::count(once.out.begin(), once.out.end(), '\n'), 50);
  EXPECT_EQ(once.out, again.out);
  EXPECT_NE(once.out, start("sample", "--count 50 --seed 10").out);
  EXPECT_EQ(start("sample", "--count 2 --seed 1 --select \"name = 'rock_1'\"").out, "rock_1\nrock_1\n");
  // By volume rock_3 has 27 of 36 parts.
  const nlohmann::json drawn = json("sample", "--count 3600 --seed 1 --weight volume")["shapes"];
  const auto third = std::count_if(drawn.begin(), drawn.end(), [](const auto& s) { return s["name"] == "rock_3"; });
  EXPECT_NEAR(static_cast<double>(third), 2700, 4 * std::sqrt(3600 * 0.75 * 0.25));
  EXPECT_EQ(start("sample", "--count 5 --select 'volume < 0'").status, 3);
  EXPECT_EQ(start("sample", "--count 5 --weight volum").status, 3);
  EXPECT_EQ(start("sample", "--count 0").status, 2);
  EXPECT_NE(start("sample", "--count 5 --seed -1").err.find("--seed: expected a whole number from 0 to"),
            std::string::npos);
}

TEST_F(CatalogCommand, Export) {
  const std::string path = (folder_ / "rock.off").string();
  EXPECT_EQ(start("export", "rock_2 --off '" + path + "'").status, 0);
  EXPECT_NE(text_of(path).find("\n8 12 0\n"), std::string::npos);
  EXPECT_EQ(
      start("export", "rock_2 --level 4 --off '" + path + "' --stl '" + path + ".stl' --ply '" + path + ".ply'").status,
      0);
  EXPECT_NE(text_of(path).find("\n16 24 0\n"), std::string::npos);
  EXPECT_EQ(fs::file_size(path + ".stl"), 84 + 24 * 50u);
  EXPECT_TRUE(text_of(path + ".ply").starts_with("ply\n"));
  const std::string before = text_of(path);
  const Outcome missing = start("export", "rock_2 --level 2 --off '" + path + "'");
  EXPECT_EQ(missing.status, 3);
  EXPECT_NE(missing.err.find("it has 1, 4 parts of at most 64 vertices"), std::string::npos) << missing.err;
  EXPECT_EQ(text_of(path), before);
  EXPECT_EQ(start("export", "rock_2 --level 4 --mode enclosing --off '" + path + "'").status, 3);
  EXPECT_EQ(start("export", "rock_2 --mode enclosing --off '" + path + "'").status, 2) << "of which level?";
  EXPECT_EQ(start("export", "rock_2").status, 2);
  EXPECT_EQ(start("export", "rock_2 --level 4 --mode enclosed --off x").err,
            "talus catalog: usage: --mode: expected volume-true, enclosing or inscribed, found 'enclosed'; see talus "
            "catalog --help\n");
}

TEST_F(CatalogCommand, Rejected) {
  EXPECT_NE(start("rejected").out.find("all points in one plane"), std::string::npos);
  EXPECT_EQ(json("rejected")["rejected"][0]["source_file"], "flat.ply");
}

TEST_F(CatalogCommand, HelpAndWrongUse) {
  for (const char* arguments : {"catalog --help", "catalog list --help", "catalog sample --help"}) {
    const Outcome help = talus(arguments, folder_);
    EXPECT_EQ(help.status, 0);
    EXPECT_TRUE(help.out.starts_with("Example: talus catalog")) << help.out;
  }
  EXPECT_EQ(talus("catalog", folder_).status, 2);
  EXPECT_EQ(talus("catalog lst x", folder_).status, 2);
  EXPECT_EQ(talus("catalog list '" + (folder_ / "none.talus").string() + "'", folder_).status, 3);
  EXPECT_FALSE(fs::exists(folder_ / "none.talus"));
}

}  // namespace
