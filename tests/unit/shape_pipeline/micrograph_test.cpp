// SPDX-License-Identifier: GPL-3.0-or-later
// Micrographs drawn with known grains: outlines, touching grains, data strip, bad input.
#include "shape_pipeline/micrograph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/input_error.h"
#include "shape_pipeline/outline_truth.h"
#include "tests/support/drawn_micrograph.h"
#include "tests/support/temporary_folder.h"

namespace shape_pipeline {
namespace {

using namespace test_support;

constexpr double kPixel = 5e-7;  // [m]

MicrographOptions with_pixel() {
  MicrographOptions options;
  options.pixel_size = kPixel;
  return options;
}

double figure(const MicrographGrain& grain, const std::string& name) {
  return descriptor_value(grain.descriptors, name);
}

/// What is said against an image; empty if nothing.
std::string refusal(const std::filesystem::path& path, const MicrographOptions& options = with_pixel()) {
  try {
    digitize_micrograph(path, options);
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "";
}

/// Touching, overlapping and separate grains, a small one in the shade behind another, two at the border.
DrawnMicrograph heap() {
  DrawnMicrograph drawing;
  drawing.width = 320;
  drawing.height = 240;
  drawing.grains = {{60, 60, 30, 30, 0, 150},     {118, 60, 28, 28, 0, 170},  {95, 105, 22, 22, 0, 130},
                    {213, 62, 12, 12, 0, 75},     {190, 60, 20, 20, 0, 180},  {255, 70, 34, 20, 0.5, 150},
                    {60, 170, 40, 24, -0.4, 160}, {150, 170, 25, 25, 0, 140}, {199, 170, 24, 24, 0, 160},
                    {260, 180, 9, 9, 0, 120},     {318, 120, 20, 20, 0, 150}, {150, 238, 18, 18, 0, 150}};
  return drawing;
}

TEST(Micrograph, OutlineOfADiscIsFinerThanPixels) {
  const TemporaryFolder folder;
  for (const double shift : {0.0, 0.25, 0.5}) {  // of the pixel grid
    DrawnMicrograph drawing;
    drawing.width = drawing.height = 64;
    drawing.noise = 2;
    drawing.grains = {{32 + shift, 32, 10, 10}};
    write_drawn(folder / "disc.png", drawing);
    const Micrograph found = digitize_micrograph(folder / "disc.png", with_pixel());
    ASSERT_EQ(found.grains.size(), 1u);
    // The goal: 1 % at 20 pixels a diameter. Stair steps would give 27 % more.
    EXPECT_NEAR(figure(found.grains[0], "perimeter_imagej") / (20 * std::numbers::pi * kPixel), 1, 0.01);
    EXPECT_NEAR(figure(found.grains[0], "equivalent_diameter_area") / (20 * kPixel), 1, 0.01);
    EXPECT_GT(figure(found.grains[0], "circularity_4pi_area_over_perimeter2_imagej"), 0.98);
  }
}

TEST(Micrograph, TouchingAndShadedGrainsComeApart) {
  const TemporaryFolder folder;
  const DrawnMicrograph drawing = heap();
  write_drawn(folder / "heap.png", drawing);
  const Micrograph found = digitize_micrograph(folder / "heap.png", with_pixel());
  std::vector<Outline> truth;
  for (const DrawnGrain& grain : drawing.grains) truth.push_back(outline_of(grain));
  const OutlineScore score = score_outlines(found, truth);
  EXPECT_EQ(score.matched, truth.size());
  EXPECT_EQ(score.found, truth.size());
  EXPECT_EQ(found.grains.size(), truth.size() - 2);
  EXPECT_EQ(found.at_border.size(), 2u);
  // The largest lies apart from the others: blur and noise leave 1 %.
  const DrawnGrain& largest = drawing.grains[6];
  EXPECT_NEAR(figure(found.grains[0], "equivalent_diameter_area"),
              2 * kPixel * std::sqrt(largest.half_length * largest.half_width), 0.01 * 60 * kPixel);
  EXPECT_NEAR(figure(found.grains[0], "aspect_ratio_major_over_minor_imagej"), 40.0 / 24, 0.02);
  EXPECT_NEAR(figure(found.grains[0], "angle_ellipse_imagej"), 0.4 * 180 / std::numbers::pi, 1);
}

TEST(Micrograph, BitsColoursAndDarkGrainsGiveTheSameOutlines) {
  const TemporaryFolder folder;
  DrawnMicrograph drawing = heap();
  write_drawn(folder / "plain.png", drawing);
  write_drawn(folder / "deep.png", drawing, PixelKind::grey_16);
  write_drawn(folder / "deep.tif", drawing, PixelKind::grey_16);
  write_drawn(folder / "colour.bmp", drawing, PixelKind::colour_8);
  drawing.background = 255 - drawing.background;
  for (DrawnGrain& grain : drawing.grains) grain.grey = 255 - grain.grey;
  write_drawn(folder / "dark.png", drawing);
  const Micrograph plain = digitize_micrograph(folder / "plain.png", with_pixel());
  for (const char* name : {"deep.png", "deep.tif", "colour.bmp", "dark.png"}) {
    MicrographOptions options = with_pixel();
    options.has_dark_grains = name[1] == 'a';
    const Micrograph other = digitize_micrograph(folder / name, options);
    ASSERT_EQ(other.grains.size(), plain.grains.size()) << name;
    for (std::size_t g = 0; g < plain.grains.size(); ++g)
      // Other grey levels: rounding to 8 bits, the stretch of 16, other noise in the dark image.
      EXPECT_NEAR(figure(other.grains[g], "area_imagej") / figure(plain.grains[g], "area_imagej"), 1, 0.03) << name;
  }
}

TEST(Micrograph, DataStripIsLeftOutAndItsBarRead) {
  const TemporaryFolder folder;
  DrawnMicrograph drawing = heap();
  drawing.strip = 30;
  drawing.bar = {180, 280};
  write_drawn(folder / "strip.png", drawing);
  MicrographOptions options;
  options.scale_bar_length = 50e-6;
  const Micrograph found = digitize_micrograph(folder / "strip.png", options);
  EXPECT_EQ(found.strip_top, 240);
  EXPECT_NEAR(found.bar_pixels, 100, 0.1);
  EXPECT_NEAR(found.pixel_size, kPixel, 1e-3 * kPixel);
  EXPECT_EQ(found.grains.size(), 10u);  // letters are no grains
  EXPECT_EQ(found.at_border.size(), 2u);

  drawing.bar = {0, 0};
  write_drawn(folder / "no_bar.png", drawing);
  EXPECT_NE(refusal(folder / "no_bar.png", options).find("--pixel"), std::string::npos);
  drawing.strip = 0;
  write_drawn(folder / "no_strip.png", drawing);
  EXPECT_EQ(digitize_micrograph(folder / "no_strip.png", with_pixel()).strip_top, 240);
  EXPECT_NE(refusal(folder / "no_strip.png", options).find("data strip"), std::string::npos);
}

TEST(Micrograph, BadInputIsRefusedByName) {
  const TemporaryFolder folder;
  write_drawn(folder / "good.png", heap());
  write_drawn(folder / "good.jpg", heap());
  const std::string png = read_bytes(folder / "good.png"), jpeg = read_bytes(folder / "good.jpg");
  write_bytes(folder / "empty.png", "");
  write_bytes(folder / "cut.png", png.substr(0, png.size() / 2));
  write_bytes(folder / "cut.jpg", jpeg.substr(0, jpeg.size() / 2));
  std::string hurt = png;
  std::fill(hurt.begin() + 40, hurt.begin() + 400, '\x55');
  write_bytes(folder / "hurt.png", hurt);
  write_bytes(folder / "text.png", "this is no image at all");
  write_bytes(folder / "pgm.png", "P5\n40 40\n255\n" + std::string(800, 'a') + std::string(800, 'z'));
  write_uniform(folder / "black.png", 100, 100, 0);
  write_uniform(folder / "grey.png", 100, 100, 90);
  write_uniform(folder / "small.png", 31, 100, 90);
  DrawnMicrograph bare;
  write_drawn(folder / "noise.png", bare);
  const std::pair<const char*, const char*> expected[] = {
      {"none.png", "no such file"},   {"empty.png", "0 bytes"},       {"cut.png", "truncated PNG"},
      {"cut.jpg", "truncated JPEG"},  {"hurt.png", "save it anew"},   {"text.png", "PNG"},
      {"pgm.png", "of another kind"}, {"black.png", "black"},         {"grey.png", "uniform"},
      {"small.png", "31 x 100"},      {"noise.png", "no whole grain"}};
  for (const auto& [file, cause] : expected) {
    const std::string reason = refusal(folder / file);
    EXPECT_EQ(reason.find((folder / file).string()), 0u) << file << ": " << reason;
    EXPECT_NE(reason.find(cause), std::string::npos) << file << ": " << reason;
  }
  const std::string no_size = refusal(folder / "good.png", {});
  EXPECT_NE(no_size.find("--pixel"), std::string::npos) << no_size;
  EXPECT_NE(no_size.find("--scale-bar"), std::string::npos) << no_size;
}

TEST(Micrograph, HandOutlinesAreReadAndScored) {
  const TemporaryFolder folder;
  const auto project = [](const std::string& xs) {
    return R"({"a": {"filename": "a.png", "regions": [{"shape_attributes": {"all_points_x": [)" + xs +
           R"(], "all_points_y": [10, 10, 20, 20]}}]}})";
  };
  write_bytes(folder / "hand.json", project("10, 20, 20, 10"));
  const std::vector<Outline> truth = read_hand_outlines(folder / "hand.json", "a.png");
  ASSERT_EQ(truth.size(), 1u);
  Micrograph found;
  found.width = found.height = found.strip_top = 40;
  const auto score_of_shift = [&](double shift) {
    found.grains = {{{{10 + shift, 10}, {20 + shift, 10}, {20 + shift, 20}, {10 + shift, 20}}, {}}};
    return score_outlines(found, truth);
  };
  EXPECT_EQ(score_of_shift(3).f1, 1);  // 70 of 130 pixels
  EXPECT_EQ(score_of_shift(4).f1, 0);  // 60 of 140
  EXPECT_NEAR(score_of_shift(0).median_error(), 0, 1e-12);

  EXPECT_THROW(read_hand_outlines(folder / "hand.json", "b.png"), catalog::InputError);
  for (const std::string& text : {std::string("{"), std::string("[]"), project("1, 2"), project("\"a\", 2, 3, 4")}) {
    write_bytes(folder / "bad.json", text);
    EXPECT_THROW(read_hand_outlines(folder / "bad.json", "a.png"), catalog::InputError) << text;
  }
}

}  // namespace
}  // namespace shape_pipeline
