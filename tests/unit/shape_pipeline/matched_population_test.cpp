// SPDX-License-Identifier: GPL-3.0-or-later
// Solids made to look like outlines.
#include "shape_pipeline/matched_population.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/input_error.h"
#include "shape_pipeline/mesh_topology.h"

namespace shape_pipeline {
namespace {

/// Wavy ellipses of 20 to 60 um and aspect ratios from 0.6 to 0.95.
std::vector<Outline> wavy_ellipses(int count) {
  std::vector<Outline> outlines;
  for (int g = 0; g < count; ++g) {
    const double share = g / (count - 1.0), a = 1e-5 * (1 + 2 * share), ratio = 0.6 + 0.35 * (g * 7 % count) / count;
    Outline outline;
    for (int k = 0; k < 200; ++k) {
      const double angle = 2 * std::numbers::pi * k / 200, wave = 1 + 0.03 * std::cos(5 * angle + g);
      outline.push_back({a * wave * std::cos(angle), a * ratio * wave * std::sin(angle)});
    }
    outlines.push_back(outline);
  }
  return outlines;
}

TEST(MatchedPopulation, SilhouettesHaveTheMeansOfTheOutlines) {
  PopulationOptions options;
  options.count = 60;
  const MatchedPopulation population = matched_population(wavy_ellipses(40), 5e-7, options);
  ASSERT_EQ(population.grains.size(), 60u);
  for (const FormComparison& row : population.comparison) {
    // Size is drawn, aspect ratio and roughness are fitted; solidity and circularity follow from them.
    const double tolerance = row.name == "roughness" ? 0.1 : 0.03;
    EXPECT_NEAR(row.made_mean / row.measured_mean, 1, tolerance) << row.name;
    EXPECT_TRUE(row.agrees(options.count)) << row.name;
  }
  for (const catalog::TriangleMesh& mesh : population.grains) {
    EXPECT_TRUE(mesh_topology(mesh).is_closed());
    EXPECT_GT(signed_volume(mesh), 0);
  }
  EXPECT_NE(population.assumption.find("S/I"), std::string::npos) << population.assumption;
}

TEST(MatchedPopulation, KeepsTheThirdAxisGiven) {
  // Ellipses without waves give ellipsoids, whose bounding box along the third axis tells S/I.
  std::vector<Outline> outlines;
  for (int g = 0; g < 12; ++g) {
    Outline outline;
    for (int k = 0; k < 100; ++k) {
      const double angle = 2 * std::numbers::pi * k / 100;
      outline.push_back({1e-5 * std::cos(angle), 0.8e-5 * std::sin(angle)});
    }
    outlines.push_back(outline);
  }
  PopulationOptions options;
  options.count = 2;
  options.third_axis = 0.5;
  const MatchedPopulation population = matched_population(outlines, 1e-7, options);
  for (const catalog::TriangleMesh& mesh : population.grains) {
    catalog::Point extent{};
    for (const catalog::Point& p : mesh.vertices)
      for (std::size_t k = 0; k < 3; ++k) extent[k] = std::max(extent[k], std::abs(p[k]));
    EXPECT_NEAR(extent[2] / extent[1], 0.5, 1e-3);  // what polygons of 100 corners wave
  }
  EXPECT_NE(population.assumption.find("0.5"), std::string::npos) << population.assumption;
}

TEST(MatchedPopulation, IsTheSameForOneSeed) {
  PopulationOptions options;
  options.count = 3;
  const std::vector<Outline> outlines = wavy_ellipses(12);
  const MatchedPopulation a = matched_population(outlines, 5e-7, options),
                          b = matched_population(outlines, 5e-7, options);
  options.seed = 2;
  const MatchedPopulation other = matched_population(outlines, 5e-7, options);
  for (std::size_t g = 0; g < 3; ++g) {
    EXPECT_EQ(a.grains[g].vertices, b.grains[g].vertices);
    EXPECT_NE(a.grains[g].vertices, other.grains[g].vertices);
  }
}

TEST(MatchedPopulation, NeedsTenOutlinesThatShowAForm) {
  EXPECT_THROW(matched_population(wavy_ellipses(9), 5e-7, {}), catalog::InputError);
  EXPECT_THROW(matched_population(wavy_ellipses(40), 5e-6, {}), catalog::InputError);  // all below 20 pixels
}

}  // namespace
}  // namespace shape_pipeline
