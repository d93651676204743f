// SPDX-License-Identifier: GPL-3.0-or-later
// talus-digitize --report, as a user runs it: what must be on the page, and its pictures.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "catalog/shape_catalog.h"
#include "postprocess/svg_plot.h"
#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/virtual_parts.h"
#include "shape_pipeline/virtual_scan.h"
#include "shape_pipeline/virtual_stack.h"
#include "shape_pipeline/virtual_turntable.h"
#include "tests/support/drawn_micrograph.h"
#include "tests/support/page_pictures.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/stack_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tool_run.h"
#include "tests/unit/postprocess/well_formed.h"

namespace {

using namespace test_support;
namespace fs = std::filesystem;
namespace sp = shape_pipeline;

ToolRun digitize(const TemporaryFolder& folder, const std::string& arguments) {
  return run(folder, "'" TALUS_DIGITIZE "' " + arguments);
}

catalog::TriangleMesh coarse_rock(std::uint64_t seed) {
  sp::RockRecipe recipe;
  recipe.seed = seed;
  recipe.subdivisions = 3;
  return virtual_rock(recipe);
}

std::size_t not_white(const PagePixels& picture) {
  return picture.count([](const auto& p) { return p != std::array<int, 3>{255, 255, 255}; });
}

void expect_drawn(const PagePixels& picture) {
  const double share = static_cast<double>(not_white(picture)) / static_cast<double>(picture.pixels.size());
  EXPECT_GT(share, 0.1) << picture.caption;
  EXPECT_LT(share, 0.9) << picture.caption;
}

std::string section_of(const std::string& page, const std::string& name) {
  const std::size_t begin = page.find("\">" + name + " <span");
  EXPECT_NE(begin, std::string::npos) << name;
  return page.substr(begin, page.find("<h3 id", begin) - begin);
}

/// Grade, descriptors, checks and provenance of a shape as the catalogue has them; and nothing from elsewhere.
void expect_figures(const std::string& page, const fs::path& file) {
  const catalog::ShapeCatalog catalog(file, catalog::ShapeCatalog::Access::read_only);
  for (const catalog::ShapeId id : catalog.select("")) {
    const catalog::ShapeRecord shape = catalog.shape(id);
    const std::string section = section_of(page, shape.name);
    const auto has = [&](const std::string& text) { EXPECT_NE(section.find(text), std::string::npos) << text; };
    has("grade " + std::to_string(catalog.summary(id).grade) + "</span>");
    for (const auto& [name, value] : shape.descriptors)
      if (std::isfinite(value))
        has("<td>" + name + "</td><td class=\"number\">" + postprocess::short_number(value, 6) + "</td>");
    has("<td class=\"number\">" + postprocess::short_number(shape.mass_properties.volume, 6) + "</td>");
    ASSERT_FALSE(shape.checks.empty());
    for (const catalog::Check& check : shape.checks)
      has("<td>" + check.name + "</td><td class=\"verdict " + (check.passed ? "met\">passed" : "missed\">not passed"));
    EXPECT_EQ(shape.provenance.source_sha256.size(), 64u);
    for (const std::string& text : {shape.provenance.source_file, shape.provenance.source_sha256,
                                    shape.provenance.tool_version, postprocess::escaped(shape.provenance.options)}) {
      EXPECT_FALSE(text.empty());
      has(text);
    }
  }
  EXPECT_EQ(xml_fault(page.substr(page.find("<html"))), "");
  for (const char* link : {"src=\"http", "href=\"http", "url(", "@import", "<script"})
    EXPECT_EQ(page.find(link), std::string::npos) << link;
}

TEST(DigitizeReport, CloudsAndMeshesHaveInputResultAndMap) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "scans");
  sp::ScannerFlaws flaws;
  flaws.points = 1500;
  sp::write_cloud(folder / "scans/cloud.ply", virtual_scan(coarse_rock(1), flaws));
  catalog::TriangleMesh torn = coarse_rock(2);
  torn.faces.resize(torn.faces.size() - 20);
  sp::write_stl(folder / "scans/torn.stl", torn);
  flaws.gap_angle = 1.4;  // nearly half of it
  sp::write_cloud(folder / "scans/half.ply", virtual_scan(coarse_rock(3), flaws));
  write_bytes(folder / "scans/empty.stl", "");
  const std::string arguments = "scans nowhere.ply --unit m --into ore.talus";
  EXPECT_EQ(digitize(folder, arguments + " --report page.html").status, 3) << "two scans are bad, one is missing";
  const std::string page = read_bytes(folder / "page.html"), catalogue = read_bytes(folder / "ore.talus");
  expect_figures(page, folder / "ore.talus");

  const std::vector<PagePixels> pictures = pictures_in(page);
  ASSERT_EQ(pictures.size(), 7u) << "three a shape, the input of the one that was rejected but can be read";
  for (const PagePixels& picture : pictures) expect_drawn(picture);
  for (const std::size_t first : {0, 3}) {
    EXPECT_EQ(pictures[first].caption.find("input: "), 0u);
    EXPECT_EQ(pictures[first + 1].caption.find("result from two opposite sides"), 0u);
    EXPECT_EQ(pictures[first + 2].caption, "deviation map");
    // The input lies where the result does: their silhouettes agree but for gaps between points, and holes.
    EXPECT_NEAR(static_cast<double>(not_white(pictures[first])) / static_cast<double>(not_white(pictures[first + 1])),
                1, 0.25);
  }
  const auto is_coloured = [](const auto& p) { return std::abs(p[0] - p[2]) > 40; };
  EXPECT_GT(pictures[2].count(is_coloured), not_white(pictures[2]) / 10) << "noise of the cloud";
  const std::string cloud = section_of(page, "cloud");
  EXPECT_NE(cloud.find("distance of the result from its source, positive outside: mean "), std::string::npos);
  EXPECT_NE(cloud.find("<div class=\"scale\"><span>-"), std::string::npos);
  EXPECT_NE(cloud.find(" um</span>"), std::string::npos) << "noise of 30 um";
  EXPECT_NE(section_of(page, "half").find("spans gaps in the cloud"), std::string::npos);
  EXPECT_NE(section_of(page, "empty").find("empty"), std::string::npos);
  EXPECT_NE(section_of(page, "nowhere").find("no such file"), std::string::npos);

  // A second run skips what is there and writes the same page; without a page the catalogue is the same.
  EXPECT_EQ(digitize(folder, arguments + " --report again.html").status, 3);
  EXPECT_TRUE(read_bytes(folder / "again.html") == page);
  EXPECT_EQ(digitize(folder, "scans nowhere.ply --unit m --into other.talus").status, 3);
  EXPECT_TRUE(read_bytes(folder / "other.talus") == catalogue);
}

TEST(DigitizeReport, AMicrographHasItsOutlinesAndDistributions) {
  const TemporaryFolder folder;
  DrawnMicrograph drawing;
  for (int g = 0; g < 12; ++g)
    drawing.grains.push_back({26.0 + 48 * (g % 4), 30.0 + 50 * (g / 4), 10.0 + g, 10.0 + g, 0});
  write_drawn(folder / "powder.png", drawing);
  write_uniform(folder / "black.png", 64, 64, 0);
  const ToolRun done = digitize(
      folder, "powder.png black.png --into ore.talus --name p --pixel '0.5 um' --population 2 --report page.html");
  EXPECT_EQ(done.status, 3) << done.errors;
  const std::string page = read_bytes(folder / "page.html");
  expect_figures(page, folder / "ore.talus");
  const std::vector<PagePixels> pictures = pictures_in(page);
  ASSERT_EQ(pictures.size(), 3u) << "the overlay and two solids";
  EXPECT_EQ(pictures[0].caption, "outlines over the image: 200 x 160 pixels of 500 nm");
  const double circumferences = 2 * 3.14159 * 12 * 15.5;  // of radii 10 ... 21, drawn one pixel wide with soft edges
  const auto green = pictures[0].count([](const auto& p) { return p[1] > p[0] + 60 && p[1] > p[2] + 60; });
  EXPECT_GT(static_cast<double>(green), 0.9 * circumferences);
  EXPECT_LT(static_cast<double>(green), 2 * circumferences);
  EXPECT_NE(page.find("<td>whole, outlined in green</td><td class=\"number\">12</td>"), std::string::npos);
  // The median of the discs has a radius of 15.5 pixels: 15.5 um across.
  const std::size_t row = page.find("<td>equivalent_diameter_area</td>");
  ASSERT_NE(row, std::string::npos);
  std::istringstream cells(page.substr(page.find("m</td>", row)));
  std::string cell;
  for (int k = 0; k < 3; ++k) std::getline(cells, cell, '>');  // unit, then the 10 % and ...
  for (int k = 0; k < 2; ++k) std::getline(cells, cell, '>');  // ... the median
  EXPECT_NEAR(std::stod(cell), 15.5e-6, 0.2e-6) << cell;
  EXPECT_NE(page.find("diameter of equal area [um]"), std::string::npos);
  EXPECT_NE(section_of(page, "black").find("is black"), std::string::npos);

  EXPECT_EQ(digitize(folder, "powder.png --pixel '0.5 um' --population 0 --out tables --report alone.html").status, 0);
  const std::string alone = read_bytes(folder / "alone.html");
  EXPECT_NE(alone.find("no solids were asked for"), std::string::npos);
  EXPECT_EQ(pictures_in(alone).size(), 1u);
}

TEST(DigitizeReport, AStackHasSlicesWithItsGrainsInColour) {
  const TemporaryFolder folder;
  sp::StackRecipe recipe;
  recipe.grains = 4;
  recipe.diameter = 16;
  const sp::VirtualStack stack = virtual_stack({coarse_rock(1)}, recipe);
  write_raw_stack(folder / "ct.raw", stack.volume);
  const std::string arguments = "ct.raw --into ore.talus --report ";
  const ToolRun done = digitize(folder, arguments + "page.html");
  ASSERT_EQ(done.status, 0) << done.errors;
  const std::string page = read_bytes(folder / "page.html");
  expect_figures(page, folder / "ore.talus");
  const std::vector<PagePixels> pictures = pictures_in(page);
  ASSERT_EQ(pictures.size(), 3u + 3 * 4);
  const auto is_coloured = [](const auto& p) {
    return *std::max_element(p.begin(), p.end()) - *std::min_element(p.begin(), p.end()) > 25;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    // Bright means grain: what is coloured is bright below the tint, and nearly all that is bright is coloured.
    EXPECT_GT(pictures[k].count(is_coloured), pictures[k].pixels.size() / 40) << pictures[k].caption;
    const auto plain_bright = pictures[k].count([&](const auto& p) { return !is_coloured(p) && p[0] > 150; });
    EXPECT_LT(static_cast<double>(plain_bright), 0.1 * static_cast<double>(pictures[k].count(is_coloured)));
  }
  for (std::size_t k = 3; k < pictures.size(); ++k)
    EXPECT_GT(not_white(pictures[k]), pictures[k].pixels.size() / 10) << pictures[k].caption;
  EXPECT_EQ(pictures[3].caption.find("input: sections through its centre"), 0u);
  EXPECT_NE(page.find("<i class=\"swatch\""), std::string::npos);
  // The surface follows the grey values: below a tenth of a voxel of 10 um on average.
  const std::string scale = "positive outside: mean ";
  const std::size_t mean = page.find(scale);
  ASSERT_NE(mean, std::string::npos);
  const std::string text = page.substr(mean + scale.size(), 20);
  EXPECT_LT(std::stod(text) * (text.find(" nm") < 10 ? 1e-9 : 1e-6), 1e-6) << text;
  EXPECT_EQ(digitize(folder, arguments + "again.html").status, 0);
  EXPECT_TRUE(read_bytes(folder / "again.html") == page);
}

TEST(DigitizeReport, ATurntableHasTheHullsOutlineOverItsViews) {
  const TemporaryFolder folder;
  sp::TurntableRecipe recipe;
  recipe.views = 8;
  recipe.side = 96;
  sp::write_turntable(folder / "rock", virtual_turntable(coarse_rock(1), recipe));
  const ToolRun done = digitize(folder, "--turntable rock --into ore.talus --cells 60 --report page.html");
  ASSERT_EQ(done.status, 0) << done.errors;
  const std::string page = read_bytes(folder / "page.html");
  expect_figures(page, folder / "ore.talus");
  const std::vector<PagePixels> pictures = pictures_in(page);
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].width, 6 * 96 + 5 * 4);
  const auto red = pictures[0].count([](const auto& p) { return p == std::array<int, 3>{230, 40, 40}; });
  EXPECT_GT(red, 6u * 100) << "outlines of six views";
  EXPECT_LT(red, 6u * 400);
}

TEST(DigitizeReport, GrainsOfAPlateAreDrawnFromTheCloudWithoutItsFloor) {
  const TemporaryFolder folder;
  sp::write_cloud(folder / "plate.ply", sp::virtual_plate(2, 2000, 3e-5).cloud);
  const ToolRun done =
      digitize(folder, "plate.ply --remove-plane --separate --into ore.talus --unit m --report page.html");
  ASSERT_EQ(done.status, 0) << done.errors;
  const std::string page = read_bytes(folder / "page.html");
  expect_figures(page, folder / "ore.talus");
  const std::vector<PagePixels> pictures = pictures_in(page);
  ASSERT_EQ(pictures.size(), 1u + 2 * 3);
  for (const PagePixels& picture : pictures) expect_drawn(picture);
  EXPECT_NE(section_of(page, "plate_02").find("grey where the source has nothing near"), std::string::npos)
      << "the hidden foot";
}

TEST(DigitizeReport, OnlyAHundredGrainsArePictured) {
  const TemporaryFolder folder;
  sp::write_stl(folder / "box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  std::string missing;
  for (int k = 0; k < 100; ++k) missing += "no" + std::to_string(k) + ".stl ";
  const std::string end = "box.stl --unit mm --into a.talus --report page.html";
  EXPECT_EQ(digitize(folder, missing + end).status, 3);
  const std::string page = read_bytes(folder / "page.html");
  EXPECT_NE(page.find("Pictures of the first 100 of 101 grains"), std::string::npos);
  EXPECT_TRUE(pictures_in(page).empty());
  expect_figures(page, folder / "a.talus");
  EXPECT_EQ(digitize(folder, missing.substr(0, missing.rfind("no")) + end).status, 3);
  EXPECT_EQ(pictures_in(read_bytes(folder / "page.html")).size(), 3u);
}

TEST(DigitizeReport, AShapeOfAnOlderVersionIsShownWithoutItsInput) {
  const TemporaryFolder folder;
  sp::write_stl(folder / "box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  const std::string arguments = "box.stl --unit mm --into a.talus --report page.html";
  ASSERT_EQ(digitize(folder, arguments).status, 0);
  sqlite3* file = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "a.talus").c_str(), &file), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(file, "UPDATE shapes SET source_frame = NULL", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(file);
  ASSERT_EQ(digitize(folder, arguments).status, 0);
  const std::string page = read_bytes(folder / "page.html");
  EXPECT_NE(page.find("Its place in its source was not kept"), std::string::npos);
  EXPECT_EQ(pictures_in(page).size(), 1u);
  expect_figures(page, folder / "a.talus");
}

TEST(DigitizeReport, APlaceThatCannotHoldThePageIsRefusedBeforeAnythingIsDone) {
  const TemporaryFolder folder;
  sp::write_stl(folder / "box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  fs::create_directory(folder / "pages");
  for (const char* place : {"nowhere/page.html", "pages", "a.talus", "box.stl"}) {
    const ToolRun refused = digitize(folder, "box.stl --unit mm --into a.talus --report " + std::string(place));
    EXPECT_EQ(refused.status, 3) << refused.errors;
    EXPECT_NE(refused.errors.find("--report"), std::string::npos) << refused.errors;
    EXPECT_FALSE(fs::exists(folder / "a.talus"));
  }
}

}  // namespace
