// SPDX-License-Identifier: Apache-2.0
// The cheap cases of the benches, run in process: what they measure against closed forms must hold.

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "catalog/input_error.h"
#include "tests/support/precision.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_report.h"
#include "workflows/bench/bench_shapes.h"

namespace {

using namespace workflows;
using dem_gpu::DepthPotential;
using dem_gpu::OverlapProbe;
using dem_gpu::Vec3;

CaseResult measured(const std::string& bench, const std::string& name) {
  for (const BenchCase& bench_case : bench_named(bench).plan({}).cases)
    if (bench_case.name == name) return bench_case.measure();
  throw std::runtime_error("no case " + name);
}

double value_of(const CaseResult& result, const std::string& name) {
  for (const Figure& figure : result.figures)
    if (figure.name == name) return figure.value.value();
  throw std::runtime_error("no figure " + name);
}

TEST(BenchCases, ClosedFormsOfTheOverlapHold) {
  int checked = 0;
  for (const BenchCase& bench_case : bench_named("overlap").plan({}).cases) {
    if (bench_case.name.starts_with("cost")) continue;
    for (const Figure& figure : bench_case.measure().figures) {
      ++checked;
      EXPECT_EQ(is_goal_met(figure), true) << bench_case.name << ", " << figure.name;
    }
  }
  EXPECT_GT(checked, 30);
}

TEST(BenchCases, EachCaseAndEachFigureHasANameOfItsOwn) {
  for (const Bench& bench : benches()) {
    std::set<std::string> names;
    for (const BenchCase& bench_case : bench.plan({}).cases)
      EXPECT_TRUE(names.insert(bench_case.name).second) << bench.name << " " << bench_case.name;
  }
  std::set<std::string> figures;
  for (const Figure& figure : measured("contact", "sphere-linear").figures)
    EXPECT_TRUE(figures.insert(figure.name).second) << figure.name;
}

TEST(BenchCases, TheVolumeLawGainsEnergyWhereTheDepthPotentialKeepsIt) {
  const std::string work = "net work over the swing of energy";
  for (const std::string path : {"face-slide", "edge-edge"}) {
    EXPECT_LT(value_of(measured("laws", path + "-depth"), work), 1e-5) << path;
    EXPECT_GT(value_of(measured("laws", path + "-volume"), work), 1e-2) << path;
  }
}

// Velocity Verlet: the contact time's error falls with the square of the step. Spheres are integrated within the step:
// faster than that.
TEST(BenchCases, ContactTimeConvergesWithSecondOrderOrBetter) {
  for (const std::string impact : {"sphere-linear", "sphere-hertz-pair", "cube-face"}) {
    const CaseResult result = measured("contact", impact);
    const double coarse = value_of(result, "contact time, relative error, 20 steps");
    const double fine = value_of(result, "contact time, relative error, 80 steps");
    const double order = std::log2(coarse / fine) / 2;
    EXPECT_GT(order, 1.9) << impact;
    if (impact == "cube-face") {
      EXPECT_LT(order, 2.1 + test_support::kSingle.touch / (2 * std::numbers::ln2 * fine));
    }
  }
}

TEST(BenchShapes, CutsKeepTheVolume) {
  EXPECT_NEAR(cut_box_shape({1, 2, 3}, {2, 3, 4}).volume, 6, 1e-12);
  EXPECT_NEAR(l_shape(2).volume, 3, 1e-12);
  EXPECT_NEAR(l_shape(3).volume, 3, 1e-12);
  EXPECT_NEAR(tetrahedron_shape().volume, 1.0 / 3, 1e-12);
  EXPECT_NEAR(octahedron_shape().volume, 4.0 / 3, 1e-12);
}

TEST(BenchShapes, TheEngineTakesThem) {
  for (const dem_gpu::Shape& shape :
       {cut_box_shape({1, 1, 1}, {2, 2, 2}), l_shape(2), l_shape(3), tetrahedron_shape(), octahedron_shape()})
    EXPECT_NO_THROW(dem_gpu::polyhedral_shape(shape.name, std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts));
}

TEST(OverlapProbe, ScaleEntersAsItsPowers) {
  const OverlapProbe probe(box_shape({1, 1, 1}), box_shape({1, 1, 1}), DepthPotential{1});
  const dem_gpu::PosePair unit{{}, {{0.9, 0.3, 0.2}}}, tripled{{{}, {}, 3}, {{2.7, 0.9, 0.6}, {}, 3}};
  EXPECT_NEAR(probe.overlap(tripled).volume, 27 * probe.overlap(unit).volume, 1e-12);
  EXPECT_NEAR(norm(probe.overlap(tripled).area - 9 * probe.overlap(unit).area), 0, 1e-12);
  EXPECT_NEAR(norm(probe.overlap(tripled).centroid - 3 * probe.overlap(unit).centroid), 0, 1e-12);
  EXPECT_NEAR(norm(probe.contact(tripled).force - 27 * probe.contact(unit).force), 0, 1e-12);
  EXPECT_NEAR(norm(probe.contact(tripled).torque_a - 81 * probe.contact(unit).torque_a), 0, 1e-12);
}

TEST(OverlapProbe, ABatchFindsTheSameContactsWithAndWithoutItsCache) {
  const OverlapProbe probe(box_shape({1, 1, 1}), box_shape({1, 1, 1}), DepthPotential{1});
  std::mt19937_64 random(3);
  std::vector<dem_gpu::PosePair> pairs;
  int touching = 0;
  for (int i = 0; i < 200; ++i) {
    pairs.push_back({{{}, random_rotation(random)},
                     {uniform(random, 0.8, 1.7) * random_direction(random), random_rotation(random)}});
    touching += norm(probe.contact(pairs.back()).force) > 0;
  }
  dem_gpu::SeparationCache cache;
  EXPECT_EQ(probe.count_contacts(pairs, cache), touching);
  EXPECT_EQ(probe.count_contacts(pairs, cache), touching);
  EXPECT_GT(touching, 20);
  EXPECT_LT(touching, 180);
}

TEST(OverlapProbe, RefusesASphere) {
  EXPECT_THROW(OverlapProbe(dem_gpu::sphere_shape("ball", 1), box_shape({1, 1, 1}), DepthPotential{1}),
               catalog::InputError);
}

}  // namespace
