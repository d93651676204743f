// SPDX-License-Identifier: Apache-2.0
#include "postprocess/run_report.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include <nlohmann/json.hpp>

#include "catalog/input_error.h"
#include "postprocess/report/base64.h"
#include "postprocess/report/viewer_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/postprocess/synthetic_run.h"
#include "tests/unit/postprocess/well_formed.h"

namespace postprocess {
namespace {

using test_support::TemporaryFolder;
using test_support::write_bytes;

struct Report {
  RunFolder run;
  RunFigures figures;
  std::string html;
};

Report report_of(const std::filesystem::path& folder) {
  Report report;
  report.run = read_run_folder(folder);
  ReportContents contents;
  for (const auto& file : report.run.snapshots) contents.frames.push_back(dem_gpu::read_snapshot(file));
  report.figures = run_figures(report.run, contents.frames.back());
  contents.no_pictures_because = "this is a test";
  contents.plots = run_plots(report.run, report.figures);
  for (const NamedPlot& plot : contents.plots) EXPECT_EQ(test_support::xml_fault(plot.svg), "") << plot.name;
  contents.view = picture_view(report.run.geometry, contents.frames, report.run.up);
  report.html = run_report_html(report.run, report.figures, contents);
  return report;
}

std::set<std::string> plot_names(const Report& report) {
  std::set<std::string> names;
  for (const NamedPlot& plot : run_plots(report.run, report.figures)) names.insert(plot.name);
  return names;
}

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Base64, Rfc4648Vectors) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(MillReport, FindsThePowerThatWentInByBothRoutes) {
  const TemporaryFolder folder;
  const test_support::MillTruth truth = test_support::write_mill_run(folder.path());
  const Report report = report_of(folder.path());
  ASSERT_TRUE(report.figures.mill);
  EXPECT_NEAR(report.figures.mill->angular_speed, truth.angular_speed, 1e-6);
  EXPECT_NEAR(report.figures.mill->torque_power.mean, truth.power, 0.01 * truth.power);
  EXPECT_NEAR(report.figures.mill->ledger_power.mean, truth.power, 0.01 * truth.power);
  EXPECT_EQ(report.figures.mill->window.revolutions, 1);
  EXPECT_FALSE(report.figures.discharged);
  EXPECT_TRUE(plot_names(report).contains("power"));
  EXPECT_FALSE(plot_names(report).contains("discharge_rate"));
}

TEST(MillReport, AxisIsFoundFromTheWallsWhereRunJsonLacksIt) {
  const TemporaryFolder folder;
  const test_support::MillTruth truth = test_support::write_mill_run(folder.path());
  std::filesystem::remove(folder / "run.json");
  const Report report = report_of(folder.path());
  ASSERT_TRUE(report.figures.mill);
  EXPECT_NEAR(report.figures.mill->torque_power.mean, truth.power, 0.01 * truth.power);
  EXPECT_NE(report.html.find("has no run.json"), std::string::npos);
}

TEST(MillReport, ShowsTrustFirstAndEveryFigure) {
  const TemporaryFolder folder;
  test_support::write_mill_run(folder.path());
  const std::string html = report_of(folder.path()).html;
  EXPECT_LT(html.find("How far to trust this run"), html.find("<h2>Results"));
  for (const char* text : {"Test mill &lt;8 lifters&gt;", "0.4 %", "at most 2 %", "closes", "1.3 %", "18.4",
                           "power from torque", "power from the energy ledger", "23.9 rpm", "3.1 %",
                           "3 bodies were placed twice", "talus simulate mill.toml --out runs/mill", "d50 30.2 mm",
                           "No pictures: this is a test.", "id=\"viewer\"", "narrow_phase", "lifter 1", "7850 kg/m³"})
    EXPECT_NE(html.find(text), std::string::npos) << text;
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
  EXPECT_EQ(html.find("<8 lifters>"), std::string::npos);
}

TEST(MillReport, OwnsUpToABalanceThatDoesNotClose) {
  const TemporaryFolder folder;
  test_support::write_mill_run(folder.path());
  write_bytes(folder / "run.json", R"({"name": "x", "energy": {"imbalance": -21, "throughput": 1000}})");
  const Report report = report_of(folder.path());
  EXPECT_FALSE(report.figures.energy_balance_closes());
  EXPECT_NE(report.html.find("does not close"), std::string::npos);
  EXPECT_NE(report.html.find("2.1 %"), std::string::npos);
  EXPECT_NE(report.html.find("stopped before its end"), std::string::npos);
}

TEST(HopperReport, FindsTheRateThatWentIn) {
  const TemporaryFolder folder;
  const test_support::HopperTruth truth = test_support::write_hopper_run(folder.path());
  const Report report = report_of(folder.path());
  ASSERT_TRUE(report.figures.discharged);
  EXPECT_NEAR(report.figures.discharged->rate.mean, truth.rate, 1e-9);
  EXPECT_NEAR(report.figures.discharged->first_time, truth.opening_time, 0.051);
  EXPECT_FALSE(report.figures.mill);
  for (const char* name : {"discharge_mass", "discharge_count", "discharge_rate", "energy", "energy_balance"})
    EXPECT_TRUE(plot_names(report).contains(name)) << name;
  EXPECT_NE(report.html.find("<b>2 kg/s</b>"), std::string::npos);
}

TEST(HopperReport, MiddlePictureIsWhereHalfHasLeft) {
  const TemporaryFolder folder;
  test_support::write_hopper_run(folder.path());
  const RunFolder run = read_run_folder(folder.path());
  // 18 kg leave at 2 kg/s from 1 s on: half has left at 5.5 s.
  EXPECT_EQ(pictured_snapshots(run, {0, 2, 4, 6, 8, 10}), (std::vector<std::size_t>{0, 3, 5}));
  EXPECT_EQ(pictured_snapshots(run, {0}), (std::vector<std::size_t>{0}));
  EXPECT_TRUE(pictured_snapshots(run, {}).empty());
}

TEST(Report, EqualRunsGiveEqualBytes) {
  const TemporaryFolder a, b;
  test_support::write_mill_run(a.path());
  test_support::write_mill_run(b.path());
  EXPECT_EQ(report_of(a.path()).html, report_of(b.path()).html);
}

TEST(FiguresJson, IsOneParsableLine) {
  const TemporaryFolder folder;
  test_support::write_mill_run(folder.path());
  const Report report = report_of(folder.path());
  const std::string line = figures_json(report.run, report.figures);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto json = nlohmann::json::parse(line);
  EXPECT_TRUE(json.at("energy_balance_closes").get<bool>());
  EXPECT_NEAR(json.at("mill").at("power_torque_W").get<double>(), 100, 1);
}

TEST(ViewerScene, HoldsEveryBodyInEveryFrame) {
  const auto geometry = test_support::hopper_geometry();
  const std::vector<dem_gpu::Snapshot> frames{test_support::hopper_snapshot(geometry, 0),
                                              test_support::hopper_snapshot(geometry, 2)};
  const PictureView view = picture_view(geometry, frames, {0, 0, 1});
  const auto scene = nlohmann::json::parse(viewer_scene_json(geometry, frames, view, {0, 0, 1}));
  const std::size_t bodies = geometry.body_shape.size();
  const auto decoded_size = [](const nlohmann::json& text) {
    const std::string s = text.get<std::string>();
    return s.size() / 4 * 3 - (s.ends_with("==") ? 2 : s.ends_with("=") ? 1 : 0);
  };
  EXPECT_EQ(scene["frames"].size(), 2u);
  EXPECT_EQ(scene["shapes"].size(), 2u);
  EXPECT_EQ(scene["walls"].size(), 3u);
  for (const auto& frame : scene["frames"]) {
    EXPECT_EQ(decoded_size(frame["place"]), bodies * 3 * 2);
    EXPECT_EQ(decoded_size(frame["turn"]), bodies * 4 * 2);
    EXPECT_EQ(decoded_size(frame["speed"]), bodies);
    EXPECT_EQ(decoded_size(frame["walls"]), 3u * 8 * 4);
  }
  EXPECT_EQ(viewer_frames(1000, 400).size(), 60u);
  EXPECT_EQ(viewer_frames(1000, 400).back(), 999u);
  EXPECT_EQ(viewer_frames(3, 400), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(viewer_frames(10, 10'000'000), (std::vector<std::size_t>{9}));
}

TEST(RunFolder, SaysWhatIsWrongAndWhere) {
  const TemporaryFolder folder;
  const auto read = [&] { return refusal([&] { read_run_folder(folder.path()); }); };
  EXPECT_NE(refusal([&] { read_run_folder(folder / "absent"); }).find("no such folder"), std::string::npos);
  EXPECT_NE(read().find("not a run folder"), std::string::npos);
  test_support::write_mill_run(folder.path());
  EXPECT_EQ(read(), "");
  write_bytes(folder / "run.json", "{\"name\": \"x\", ");
  EXPECT_NE(read().find("run.json: byte"), std::string::npos);
  write_bytes(folder / "run.json", R"({"energy": {"imbalance": "small"}})");
  EXPECT_NE(read().find("energy.imbalance: expected a number"), std::string::npos);
  write_bytes(folder / "run.json", R"({"shapes": [{"name": "a"}, {"name": 3}]})");
  EXPECT_NE(read().find("shapes[1].name: expected a string"), std::string::npos);
  write_bytes(folder / "run.json", R"({"size_distribution": {"requested": [[0.01]]}})");
  EXPECT_NE(read().find("size_distribution.requested: expected rows"), std::string::npos);
  write_bytes(folder / "run.json", "[]");
  EXPECT_NE(read().find("expected an object"), std::string::npos);
  write_bytes(folder / "run.json", "{}");
  EXPECT_EQ(read(), "");
  write_bytes(folder / "ledger.csv", "time[s],class,dissipation_normal[J]\n0,a\n");
  EXPECT_NE(read().find("ledger.csv: line 2"), std::string::npos);
}

TEST(RunFolder, SizeRowsMayHoldPassingByMassAndByNumber) {
  const TemporaryFolder folder;
  for (const auto& [basis, passing] : {std::pair{"mass", 0.5}, {"number", 0.7}}) {
    write_bytes(folder / "run.json",
                std::string(R"({"size_distribution": {"basis": ")") + basis + R"(", "realised": [[0.01, 0.5, 0.7]]}})");
    EXPECT_EQ(read_run_summary(folder / "run.json").size_distribution->realised.at(0).second, passing);
  }
}

TEST(RunFolder, GravityGivesUp) {
  const TemporaryFolder folder;
  test_support::write_hopper_run(folder.path());
  write_bytes(folder / "resolved_scene.json", R"({"gravity": [0, 9.81, 0]})");
  const RunFolder run = read_run_folder(folder.path());
  EXPECT_DOUBLE_EQ(run.up.y, -1);
}

}  // namespace
}  // namespace postprocess
