// SPDX-License-Identifier: Apache-2.0
#include "catalog/grade.h"

#include <gtest/gtest.h>

#include "catalog/shape_catalog.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace catalog;
using Checks = std::vector<Check>;

Check passed(const char* name) { return {name, true, 0, ""}; }
Check failed(const char* name) { return {name, false, 0, ""}; }

TEST(Grade, IsOfTheWorstCheck) {
  EXPECT_EQ(grade_of(Checks{passed("closed"), passed("cloud_points")}), 1);
  EXPECT_EQ(grade_of(Checks{passed("closed"), failed("given_normals")}), 2);
  EXPECT_EQ(grade_of(Checks{passed("closed"), failed("population_solidity")}), 2);
  EXPECT_EQ(grade_of(Checks{failed("given_normals"), failed("volume_second_method"), passed("closed")}), 3);
  EXPECT_EQ(grade_of(Checks{failed("volume_error_truth")}), 3);
}

TEST(Grade, AnAssumptionOrAnotherWayIsAReservationThoughItsCheckPasses) {
  for (const char* name : {"assumed_third_axis", "visual_hull", "repair_alpha_wrap", "reconstruction_alpha_wrap"})
    EXPECT_EQ(grade_of(Checks{passed("closed"), passed(name)}), 2) << name;
}

TEST(Grade, WhatIsUnknownOrMissingIsNotTrusted) {
  EXPECT_EQ(grade_of(Checks{}), 3);
  EXPECT_EQ(grade_of(Checks{passed("closed"), failed("some_new_check")}), 3);
}

TEST(Grade, FlawsOfAMeshThatWasReplacedInform) {
  EXPECT_EQ(grade_of(Checks{failed("self_intersections"), failed("repaired_solid"), passed("closed")}), 2);
  EXPECT_EQ(grade_of(Checks{failed("repaired_solid"), passed("closed"), failed("deviation_mean")}), 3);
  EXPECT_EQ(grade_of(Checks{failed("volume_second_method"), failed("repaired_solid")}), 3) << "of another body";
  EXPECT_EQ(grade_of(Checks{failed("self_intersections"), passed("closed")}), 3);
}

TEST(Grade, IsStoredAndSelects) {
  const test_support::TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", ShapeCatalog::Access::read_write);
  ShapeRecord shape = test_support::sample_shape("rock");
  for (const auto& [name, checks] :
       {std::pair("good", Checks{passed("closed")}), std::pair("fair", Checks{failed("given_normals")}),
        std::pair("poor", Checks{failed("closed")})}) {
    shape.name = name;
    shape.checks = checks;
    catalog.store_shape(shape);
  }
  const auto selected = [&](const std::string& query) {
    std::string names;
    for (const ShapeId id : catalog.select(query)) names += catalog.summary(id).name + " ";
    return names;
  };
  EXPECT_EQ(selected("grade <= 2"), "fair good ");
  EXPECT_EQ(selected("Grade = 3 or name = 'good'"), "good poor ");
  shape.checks = {passed("closed")};
  EXPECT_EQ(catalog.summary(catalog.store_shape(shape)).grade, 1) << "a shape stored anew is graded anew";
}

}  // namespace
