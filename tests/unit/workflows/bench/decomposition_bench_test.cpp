// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the bench decomposition that are right or wrong by themselves; the program is in bench_program_test.cpp.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"
#include "workflows/bench/bench_report.h"
#include "workflows/bench/decomposition/bench_levels.h"
#include "workflows/bench/decomposition/decomposition_page.h"
#include "workflows/bench/decomposition/goal_rows.h"
#include "workflows/bench/decomposition/markdown_table.h"
#include "workflows/bench/decomposition/search_study.h"
#include "workflows/bench/decomposition/solids.h"

namespace {

using namespace workflows;
using test_support::box_part;

/// A run with that symmetric difference and figures within every rule.
LevelRun run_of(double difference, int face_cap = 0) {
  LevelRun run;
  run.level.key = {8, 64, face_cap};
  run.level.error.symmetric_difference = difference;
  run.figures.shortest_edge = 0.02;
  run.figures.narrowest_face = 0.03;
  return run;
}

/// The first row: stone14, 8 x 64, goal 4.2 %, stretch 3.8 %.
std::vector<Figure> figures_of(std::vector<LevelRun> runs) { return row_figures(goal_rows().front(), runs); }

bool all_met(const std::vector<Figure>& figures) {
  for (const Figure& figure : figures)
    if (is_goal_met(figure) == false) return false;
  return true;
}

TEST(GoalRows, AreTheTenOfTheGoalsEachWithAStretchBelowIt) {
  std::set<std::string> names;
  for (const GoalRow& row : goal_rows()) {
    names.insert(row.solid + " " + row.text());
    EXPECT_LT(row.stretch, row.goal);
  }
  EXPECT_EQ(names.size(), 10u);
  EXPECT_TRUE(names.contains("stone14 8 x 64, enclosing"));
}

TEST(GoalRows, TheMedianOfTheSeedsIsHeldAgainstTheGoal) {
  const std::vector<Figure> figures =
      figures_of({run_of(0.05), run_of(0.041), run_of(0.039), run_of(0.042), run_of(0.08)});
  EXPECT_EQ(figures[0].name, "8 parts: symmetric difference, median");
  EXPECT_DOUBLE_EQ(*figures[0].value, 4.2);
  EXPECT_TRUE(all_met(figures));
  EXPECT_DOUBLE_EQ(*figures[1].value, 3.9);
  EXPECT_DOUBLE_EQ(*figures[2].value, 8);
  EXPECT_FALSE(all_met(figures_of({run_of(0.0421)})));
}

TEST(GoalRows, EveryRuleIsAGoalUnderCapsOfFacesToo) {
  const auto broken = [](auto change, int face_cap = 0) {
    LevelRun run = run_of(0.04, face_cap);
    change(run);
    return !all_met(figures_of({run_of(0.04, face_cap), run, run_of(0.04, face_cap)}));
  };
  EXPECT_FALSE(broken([](LevelRun&) {}));
  EXPECT_TRUE(broken([](LevelRun& run) { run.level.error.volume_error = -0.0011; }));
  EXPECT_TRUE(broken([](LevelRun& run) { run.overlapping_pairs = 1; }));
  EXPECT_TRUE(broken([](LevelRun& run) { run.figures.shortest_edge = 0.009; }));
  EXPECT_TRUE(broken([](LevelRun& run) { run.figures.narrowest_face = 0.019; }));
  EXPECT_TRUE(broken([](LevelRun& run) { run.figures.narrowest_face = 0.019; }, 24));
  EXPECT_TRUE(all_met(figures_of({run_of(0.05, 24)}))) << "the goals of the difference are those without a cap";
  GoalRow enclosing = goal_rows().front();
  enclosing.mode = catalog::FitMode::enclosing;
  LevelRun run = run_of(0.04);
  run.level.error.volume_error = 0.1;
  EXPECT_TRUE(all_met(row_figures(enclosing, {run})));
  run.level.error.missing_volume = 1e-6;
  EXPECT_FALSE(all_met(row_figures(enclosing, {run})));
}

TEST(LadderRuns, PairsOfPartsThatOverlapAreCountedToTheLastBit) {
  const catalog::ConvexPart left = box_part({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(overlapping_pairs({left, box_part({1, 0, 0}, {2, 1, 1})}), 0);
  EXPECT_EQ(overlapping_pairs({left, box_part({1 - 1e-15, 0, 0}, {2, 1, 1})}), 1);
  EXPECT_EQ(overlapping_pairs({left, left, left}), 3);
}

TEST(LadderRuns, ABoxIsExactAtEveryLevel) {
  const catalog::TriangleMesh box = test_support::box_mesh({0, 0, 0}, {1, 2, 3});
  const std::vector<LevelRun> runs = run_ladder(box, {1, 2}, {});
  ASSERT_EQ(runs.size(), 2u);
  for (const LevelRun& run : runs) {
    EXPECT_EQ(run.figures.faces, 6);
    EXPECT_EQ(run.overlapping_pairs, 0);
    EXPECT_NEAR(run.level.error.symmetric_difference, 0, 1e-12);
    EXPECT_GT(run.cpu_seconds, 0);
  }
}

TEST(BenchSolids, TheTorusNeedsNoFileAndScansAreFoundByTheirNames) {
  const test_support::TemporaryFolder folder;
  // Octahedron of volume 4/3: the mesh as it is, in no particular unit.
  test_support::write_bytes(folder / "ashlar_1050.obj",
                            "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
                            "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
  BenchSolids solids(folder.path());
  EXPECT_TRUE(solids.has("torus"));
  EXPECT_TRUE(solids.has("ashlar_1050"));
  EXPECT_FALSE(solids.has("stone14"));
  EXPECT_EQ(solids.missing().size(), 3u);
  EXPECT_EQ(solids.missing()[0], "stone14 (epfl_stone14.stl)");
  EXPECT_NEAR(catalog::volume_moments(solids.mesh("ashlar_1050")).volume, 4.0 / 3, 1e-12);
  EXPECT_EQ(solids.mesh("torus").face_count(), 576u);
  // 2 pi^2 R r^2 less what the chords cut off: a polygon of n corners has n / (2 pi) sin(2 pi / n) of its circle, and
  // turned in m steps the ring has m / (2 pi) sin(2 pi / m) of its length for each radius.
  const double whole = 2 * M_PI * M_PI * 0.16;
  EXPECT_NEAR(catalog::volume_moments(solids.mesh("torus")).volume,
              whole * 12 / (2 * M_PI) * std::sin(2 * M_PI / 12) * 24 / (2 * M_PI) * std::sin(2 * M_PI / 24),
              0.005 * whole);
  EXPECT_THROW(BenchSolids(folder / "nowhere"), catalog::InputError);
  EXPECT_EQ(BenchSolids("").missing().size(), 4u);
}

/// Figures of a case as the bench hands them to the page.
void report(std::vector<ReportedFigure>& all, const std::string& case_name, const std::vector<Figure>& figures) {
  for (const Figure& figure : figures) all.push_back({"decomposition", case_name, figure, "talus bench"});
}

TEST(DecompositionPage, ShowsVerdictsAndWhatWasLeftOut) {
  std::vector<ReportedFigure> figures;
  const std::vector<GoalRow>& rows = goal_rows();
  report(figures, "stone14-64", row_figures(rows[0], {run_of(0.037)}));
  report(figures, "stone14-32", row_figures(rows[1], {run_of(0.041)}));
  report(figures, "stone14-64", row_figures(rows[2], {run_of(0.1)}));
  report(figures, "stone14-64-f24", row_figures(rows[0], {run_of(0.06, 24)}));
  report(figures, "time-stone14", {{"8 parts x 64 vertices, CPU time, median", 6, "s", at_most(5), ""}});
  report(figures, "stone14-64", {{kCaseTime, 90, "s", {}, ""}});
  report(figures, "time-stone14", {{kCaseTime, 30, "s", {}, ""}});
  const std::string page =
      decomposition_page(figures, {{"itokawa (itokawa_radar_25143.tab)"},
                                   {"stone14-64", "torus-64", "time-stone14", "effort-stone14", "front-torus"},
                                   1});
  std::size_t at = 0;
  for (const char* expected :
       {"took 2.0 CPU minutes: 1.5 for the rows of goals, 0.5 for times", "for want of files: itokawa",
        "Not run (`--case NAME` measures one, `--resume` all that are missing): torus-64, effort-stone14, "
        "front-torus.\n",
        "| stone14 | 8 x 64 ", " stretch |\n", "| stone14 | 8 x 32 ", " goal |\n", "| stone14 | 1 x 64 ", " missed |\n",
        "under a cap of 24 faces", "## Other errors", "## Rules", "| missed  |"}) {
    const std::size_t found = page.find(expected, at);
    ASSERT_NE(found, std::string::npos) << expected << " in\n" << page;
    at = found;
  }
  EXPECT_EQ(page.find("## Front"), std::string::npos) << "nothing measured, no section";
  EXPECT_EQ(page.find("cap of 34"), std::string::npos);
}

TEST(DecompositionPage, TheFrontLeavesOutWhatIsDearerAndWorse) {
  std::vector<ReportedFigure> figures;
  for (const auto& [parts, difference, cost] :
       {std::tuple{1, 9.0, 9.0}, {2, 8.0, 8.0}, {4, 5.0, 12.0}, {8, 6.0, 13.0}}) {
    const catalog::LevelKey key{parts, 64};
    report(figures, "front-torus",
           {{front_figure(key, "symmetric difference"), difference, "%", {}, ""},
            {front_figure(key, "time of a contact over that of cubes"), cost, "-", {}, ""}});
  }
  const std::string page = decomposition_page(figures, {});
  EXPECT_NE(page.find("2 x 64 vertices"), std::string::npos) << page;
  EXPECT_NE(page.find("4 x 64 vertices"), std::string::npos);
  EXPECT_EQ(page.find("1 x 64 vertices"), std::string::npos);
  EXPECT_EQ(page.find("8 x 64 vertices"), std::string::npos);
}

/// A run with that difference [%], measured to 0.01 % of the volume.
LevelRun measured_run(double percent) {
  LevelRun run = run_of(percent / 100);
  run.level.error.method_error = 1e-4;
  run.cpu_seconds = percent;
  return run;
}

TEST(SearchStudy, ASetbackIsAWorseLevelForMoreTimeBeyondTheMeasurementsError) {
  // Three standard errors of two runs: 3 * sqrt(2) * 0.01 % = 0.0424 %.
  const std::vector<LevelRun> first{measured_run(4), measured_run(5)}, second{measured_run(4.042), measured_run(4.5)};
  EXPECT_EQ(setback({}, first).seeds, 0);
  EXPECT_EQ(setback({first}, second).seeds, 0);
  const Setback lost = setback({first, second}, {measured_run(4.043), measured_run(4.7)});
  EXPECT_EQ(lost.seeds, 2) << "the second is better than the first try, not than the second";
  EXPECT_NEAR(lost.largest, 0.2, 1e-12);
}

TEST(SearchStudy, TheAnytimePromiseIsAGoalAndThePageSaysWhetherItHeld) {
  SearchStudy study = kBudgetStudy;
  const auto page_of = [&](const std::vector<double>& percent, bool is_kept) {
    std::size_t next = 0;
    const CaseResult result =
        measure_search_study(study, 1, [&](int, int, double) { return measured_run(percent.at(next++)); });
    EXPECT_EQ(all_met(result.figures), is_kept);
    EXPECT_EQ(result.curves.at(0).y, percent);
    std::vector<ReportedFigure> figures;
    report(figures, kBudgetCase, result.figures);
    return decomposition_page(figures, {{}, {kBudgetCase}, 1});
  };
  const std::string good = page_of({5, 4.9, 4.6, 4.6, 4.2}, true);
  EXPECT_NE(good.find("Here more time never made a level worse."), std::string::npos) << good;
  EXPECT_NE(good.find("| stone14 | 8 x 64           |               4 |        4.600 |"), std::string::npos) << good;
  const std::string bad = page_of({5, 4.9, 4.6, 4.7, 4.75}, false);
  EXPECT_NE(bad.find("Here more time made a level worse 2 times, by 0.150 %"), std::string::npos) << bad;
}

TEST(FrontCases, EveryPlotsCurvesCanBeToldApart) {
  std::size_t caps = 0, sizes = 0;
  for (const FrontCase& front : kFrontCases) {
    if (front.ladders.size() > 1) caps += front.ladders.size();
    for (const catalog::LevelKey& ladder : front.ladders) sizes += ladder.face_cap == 0;
  }
  // As many colours as log_plot.cpp has.
  EXPECT_LE(caps, 7u);
  EXPECT_LE(sizes, 7u);
  EXPECT_LE(kFrontCases.size(), 7u) << "one curve a solid";
}

TEST(AlignedMarkdown, ColumnsAreAsWideAsTheirWidestCell) {
  EXPECT_EQ(aligned_markdown({{"shape", "level", "%"}, {"torus", "8 x 64", "12.5"}}),
            "| shape | level  |    % |\n|-------|--------|-----:|\n| torus | 8 x 64 | 12.5 |\n");
  EXPECT_EQ(fixed(1.0 / 3, 3), "0.333");
  EXPECT_EQ(fixed(std::nan(""), 3), "-");
}

}  // namespace
