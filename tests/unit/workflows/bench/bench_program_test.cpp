// SPDX-License-Identifier: Apache-2.0
// talus-bench as a program.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "catalog/shape_catalog.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"
#include "workflows/bench/bench_registry.h"

namespace {

using test_support::read_bytes;
using test_support::TemporaryFolder;

struct Ended {
  int status;
  std::string out, error;
};

Ended run_bench(const TemporaryFolder& folder, const std::string& arguments) {
  const auto out = folder / "stdout.txt", error = folder / "stderr.txt";
  const std::string command =
      "'" TALUS_BENCH "' " + arguments + " > '" + out.string() + "' 2> '" + error.string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_bytes(out), read_bytes(error)};
}

TEST(BenchProgram, ListNamesEveryBenchAndItsCases) {
  const TemporaryFolder folder;
  const Ended ended = run_bench(folder, "--list");
  EXPECT_EQ(ended.status, 0);
  for (const workflows::Bench& bench : workflows::benches()) {
    EXPECT_NE(ended.out.find(bench.name + ": "), std::string::npos);
    for (const auto& bench_case : bench.plan({}).cases)
      EXPECT_NE(ended.out.find(" " + bench_case.name), std::string::npos) << bench_case.name;
  }
}

TEST(BenchProgram, AnUnknownNameIsAUsageErrorWithASuggestion) {
  const TemporaryFolder folder;
  const Ended ended = run_bench(folder, "overlp");
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(ended.out.empty());
  EXPECT_NE(ended.error.find("did you mean 'overlap'"), std::string::npos) << ended.error;
}

TEST(BenchProgram, AnUnknownCaseIsAUsageErrorWithASuggestion) {
  const TemporaryFolder folder;
  const Ended ended = run_bench(folder, "contact --case cube-fase");
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.error.find("did you mean 'cube-face'"), std::string::npos) << ended.error;
}

TEST(BenchProgram, AnEmptyCaseAndAFolderForFiguresAreRefusedBeforeAnythingIsMeasured) {
  const TemporaryFolder folder;
  const Ended ended = run_bench(folder, "contact --case ''");
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.error.find("--case is empty"), std::string::npos) << ended.error;
  const std::string here = folder.path().string();
  for (const std::string& json : {here, here + "/made/"}) {
    const Ended named = run_bench(folder, "overlap --case cost-touching --json '" + json + "'");
    EXPECT_EQ(named.status, 2);
    EXPECT_NE(named.error.find("is a folder, expected a file"), std::string::npos) << named.error;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "made"));
}

TEST(BenchProgram, OptionsOfOtherBenchesAndBrokenNumbersAreRefused) {
  const TemporaryFolder folder;
  const Ended scans = run_bench(folder, "parts --scans X");
  EXPECT_EQ(scans.status, 2);
  EXPECT_NE(scans.error.find("--scans is for the bench decomposition, digitize and micrographs, not for 'parts'"),
            std::string::npos)
      << scans.error;
  if (run_bench(folder, "--list").out.find("\nmicrographs:") != std::string::npos) {
    const Ended without = run_bench(folder, "micrographs");
    EXPECT_EQ(without.status, 2);
    EXPECT_NE(without.error.find("--scans DIR"), std::string::npos) << without.error;
  }
  const Ended seeds = run_bench(folder, "decomposition --seeds 1.5");
  EXPECT_EQ(seeds.status, 2);
  EXPECT_NE(seeds.error.find("expected a whole number from 1 to 1000, found '1.5'"), std::string::npos) << seeds.error;
}

TEST(BenchProgram, NoNameOrAWrongOptionIsAUsageErrorAndHelpIsNot) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_bench(folder, "").status, 2);
  EXPECT_EQ(run_bench(folder, "overlap --threads none").status, 2);
  EXPECT_NE(run_bench(folder, "overlap --threads 1,,2").error.find("found '1,,2'"), std::string::npos);
  EXPECT_EQ(run_bench(folder, "overlap --threads 1025").status, 2) << "more than kMostThreads";
  for (const char* bench : {"levels", "parts"}) {
    const auto without_catalogue = run_bench(folder, bench);
    EXPECT_EQ(without_catalogue.status, 2) << bench;
    EXPECT_NE(without_catalogue.error.find("no catalogue; add --catalog"), std::string::npos)
        << without_catalogue.error;
    EXPECT_EQ(without_catalogue.error.find("[1/1]"), std::string::npos) << "begins before it looks";
  }
  EXPECT_EQ(run_bench(folder, "--help").status, 0);
}

TEST(BenchProgram, LevelsOfACatalogue) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_bench(folder, "levels").status, 2);
  const auto file = folder / "ore.talus";
  {
    catalog::ShapeCatalog catalogue(file, catalog::ShapeCatalog::Access::read_write);
    const catalog::ShapeRecord flint = test_support::sample_shape("flint");
    const catalog::ShapeId id = catalogue.store_shape(flint);
    EXPECT_EQ(run_bench(folder, "levels --catalog '" + file.string() + "'").status, 3) << "no levels yet";
    catalogue.store_levels(id, {test_support::sample_level(flint, 2)});
  }
  const Ended ended =
      run_bench(folder, "levels --catalog '" + file.string() + "' --out '" + folder.path().string() + "'");
  EXPECT_EQ(ended.status, 0) << ended.error;
  EXPECT_NE(ended.out.find("flint-64"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("2 parts: time of a contact over that of cubes"), std::string::npos);
  EXPECT_NE(read_bytes(folder / "levels_front.svg").find("flint, 64 vertices"), std::string::npos);
}

#ifdef TALUS_BENCH_DECOMPOSITION
TEST(BenchProgram, DecompositionWithoutScansMeasuresTheTorusAndSaysWhatIsLeftOut) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_bench(folder, "decomposition --scans '" + (folder / "none").string() + "'").status, 3);
  const Ended ended =
      run_bench(folder, "decomposition --case torus-64-f24 --seeds 1 --out '" + (folder / "new").string() + "'");
  EXPECT_EQ(ended.status, 0) << ended.error;
  for (const char* expected : {"Not measured, for want of files: stone14 (epfl_stone14.stl)", "cap of 24 faces",
                               "| torus | 8 x 64 ", "## Rules"})
    EXPECT_NE(ended.out.find(expected), std::string::npos) << expected;
  const std::string page = read_bytes(folder / "new/decomposition.md");
  EXPECT_TRUE(page.starts_with(ended.out)) << "the page is what was printed, and the plots";
  EXPECT_NE(page.find("Not run (`--case NAME` measures one, `--resume` all that are missing): torus-64, torus-64-f34, "
                      "front-torus.\n"),
            std::string::npos)
      << page;
  EXPECT_EQ(page.find("]("), std::string::npos) << "no plot of what was not run";
  EXPECT_FALSE(std::filesystem::exists(folder / "new/decomposition_cost.svg"));
  std::istringstream lines(read_bytes(folder / "new/decomposition.json"));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  const auto figure = nlohmann::json::parse(line);
  EXPECT_EQ(figure["figure"], "8 parts: symmetric difference, median");
  EXPECT_EQ(figure["command"], "talus bench decomposition --case torus-64-f24 --seeds 1");
  EXPECT_TRUE(figure["goal"].is_null()) << "goals are those without a cap of faces";
}
#endif

TEST(BenchProgram, JsonLinesHaveTheAgreedFieldsAndTheCommandGivesTheFigureAlone) {
  const TemporaryFolder folder;
  const Ended ended =
      run_bench(folder, "laws --case exponent-edge-depth --json '" + (folder / "laws.json").string() + "'");
  EXPECT_EQ(ended.status, 0) << ended.error;
  EXPECT_NE(ended.out.find("exponent-edge-depth"), std::string::npos);
  std::istringstream lines(read_bytes(folder / "laws.json"));
  const std::vector<std::string> fields{"bench", "case", "figure", "value", "unit", "goal", "met", "command"};
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto figure = nlohmann::ordered_json::parse(line);
    std::vector<std::string> names;
    for (const auto& [name, value] : figure.items()) names.push_back(name);
    EXPECT_EQ(names, fields);
    EXPECT_EQ(figure["bench"], "laws");
    EXPECT_TRUE(figure["value"].is_number());
    EXPECT_EQ(figure["goal"].is_null(), figure["met"].is_null());
    EXPECT_EQ(figure["command"], "talus bench laws --case exponent-edge-depth");
  }
  EXPECT_GT(count, 0);
  EXPECT_NE(read_bytes(folder / "laws.md").find("| exponent-edge-depth |"), std::string::npos);
  EXPECT_NE(read_bytes(folder / "laws_force.svg").find("<polyline"), std::string::npos);
}

TEST(BenchProgram, OutNamesAFolderForEverything) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_bench(folder, "overlap --case O1 --out '" + (folder / "new").string() + "'").status, 0);
  EXPECT_FALSE(read_bytes(folder / "new/overlap.json").empty());
  EXPECT_FALSE(read_bytes(folder / "new/overlap.md").empty());
}

TEST(BenchProgram, AStoppedBenchGoesOnWithTheCasesItHas) {
  const TemporaryFolder folder;
  const std::string json = "'" + (folder / "o.json").string() + "'", kept = "o.json.cases/O1.json";
  ASSERT_EQ(run_bench(folder, "overlap --case O1 --json " + json).status, 0);
  const std::string table = read_bytes(folder / "o.md");
  // A figure that no run gives: seen again, it was kept.
  auto marked = nlohmann::ordered_json::parse(read_bytes(folder / kept));
  marked["figures"][0]["name"] = "kept";
  test_support::write_bytes(folder / kept, marked.dump());
  ASSERT_EQ(run_bench(folder, "overlap --resume --case O1 --json " + json).status, 0);
  EXPECT_NE(read_bytes(folder / "o.md").find("| O1 | kept |"), std::string::npos);
  ASSERT_EQ(run_bench(folder, "overlap --case O1 --json " + json).status, 0) << "without --resume all is measured";
  EXPECT_EQ(read_bytes(folder / "o.md"), table);
  EXPECT_EQ(run_bench(folder, "overlap --resume --threads 1 --case O1 --json " + json).status, 0);
  EXPECT_NE(read_bytes(folder / kept).find("--threads 1"), std::string::npos) << "other options: measured anew";
  test_support::write_bytes(folder / kept, "{");
  const Ended damaged = run_bench(folder, "overlap --resume --case O1 --json " + json);
  EXPECT_EQ(damaged.status, 3);
  EXPECT_NE(damaged.error.find("O1.json: holds no case of a bench; delete it"), std::string::npos) << damaged.error;
  EXPECT_EQ(run_bench(folder, "overlap --resume --case O1").status, 2) << "nothing to go on from";
  const Ended astray = run_bench(folder, "overlap --case O1 --json '" + (folder / "o.md/x.json").string() + "'");
  EXPECT_EQ(astray.status, 3);
  EXPECT_NE(astray.error.find("o.md: is no folder"), std::string::npos) << astray.error;
}

TEST(BenchProgram, AMissedGoalEndsWithStatus4) {
  const TemporaryFolder folder;
  // The figures decide the status, whatever they are.
  const Ended ended =
      run_bench(folder, "laws --case cuts-L-2-3-depth --json '" + (folder / "cuts.json").string() + "'");
  bool is_all_met = true;
  std::istringstream lines(read_bytes(folder / "cuts.json"));
  for (std::string line; std::getline(lines, line);)
    is_all_met = is_all_met && nlohmann::json::parse(line)["met"] != false;
  EXPECT_EQ(ended.status, is_all_met ? 0 : 4);
}

}  // namespace
