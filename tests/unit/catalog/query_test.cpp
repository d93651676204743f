// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "catalog/shape_catalog.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace catalog;
using namespace test_support;

/// Four shapes: rock_1, rock_2, rock_3 of scale 1, 2, 3, and "it's" of scale 1 without sphericity.
class Query : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    catalog_ = std::make_unique<ShapeCatalog>(*folder_ / "ore.talus", ShapeCatalog::Access::read_write);
    for (const int scale : {3, 1, 2}) {
      const ShapeRecord shape = sample_shape("rock_" + std::to_string(scale), scale);
      const ShapeId id = catalog_->store_shape(shape);
      if (scale == 2) catalog_->store_levels(id, {sample_level(shape, 2)});
    }
    ShapeRecord other = sample_shape("it's");
    other.descriptors = {{"Angularity", 5}, {"bad name", 1}};
    catalog_->store_shape(other);
  }
  static void TearDownTestSuite() {
    catalog_.reset();
    folder_.reset();
  }

  static std::string names(const std::string& query) {
    std::string list;
    for (const ShapeId id : catalog_->select(query)) {
      if (!list.empty()) list += ' ';
      list += catalog_->summary(id).name;
    }
    return list;
  }
  static std::string fault(const std::string& query) {
    try {
      catalog_->select(query);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "no fault";
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static std::unique_ptr<ShapeCatalog> catalog_;
};
std::unique_ptr<TemporaryFolder> Query::folder_;
std::unique_ptr<ShapeCatalog> Query::catalog_;

TEST_F(Query, EmptySelectsAllInOrderOfName) {
  EXPECT_EQ(names(""), "it's rock_1 rock_2 rock_3");
  EXPECT_EQ(names("  \t\n"), "it's rock_1 rock_2 rock_3");
}

// The box of scale s has 2.4e-9 s^3 m3 and sphericity 0.1 + 0.2 s.
TEST_F(Query, Comparisons) {
  EXPECT_EQ(names("volume > 2.5e-9"), "rock_2 rock_3");
  EXPECT_EQ(names("2.5e-9 < volume"), "rock_2 rock_3");
  EXPECT_EQ(names("sphericity_wadell <= 0.5"), "rock_1 rock_2");
  EXPECT_EQ(names("sphericity_wadell < 0.5"), "rock_1");
  EXPECT_EQ(names("sphericity_wadell >= .5"), "rock_2 rock_3");
  EXPECT_EQ(names("sphericity_wadell = 0.5"), "rock_2");
  EXPECT_EQ(names("sphericity_wadell == +0.5"), "rock_2");
  EXPECT_EQ(names("sphericity_wadell != 0.5"), "rock_1 rock_3");
  EXPECT_EQ(names("sphericity_wadell <> 0.5"), "rock_1 rock_3");
  EXPECT_EQ(names("sphericity_wadell > -1"), "rock_1 rock_2 rock_3");
  EXPECT_EQ(names("SPHERICITY_WADELL < failed_checks"), "rock_1 rock_2");  // rock_3 has none failed
}

TEST_F(Query, ColumnsOfTheCatalogue) {
  EXPECT_EQ(names("face_count = 12 and vertex_count = 8"), "it's rock_1 rock_2 rock_3");
  EXPECT_EQ(names("failed_checks = 0"), "rock_3");
  EXPECT_EQ(names("level_count > 0"), "rock_2");
  EXPECT_EQ(names("source_file = 'rock_1.ply'"), "rock_1");
}

TEST_F(Query, TextsAndLists) {
  EXPECT_EQ(names("name like 'ROCK%'"), "rock_1 rock_2 rock_3");
  EXPECT_EQ(names("name not like 'rock__'"), "it's");
  EXPECT_EQ(names("name = 'it''s'"), "it's");
  EXPECT_EQ(names("name = \"it's\""), "it's");
  EXPECT_EQ(names("name in ('rock_1', 'rock_3', 'rock_9')"), "rock_1 rock_3");
  EXPECT_EQ(names("name not in ('rock_1', 'rock_3')"), "it's rock_2");
  EXPECT_EQ(names("face_count in (11, 12)"), "it's rock_1 rock_2 rock_3");
}

TEST_F(Query, AndBindsStrongerThanOrAndNotStrongest) {
  EXPECT_EQ(names("name = 'rock_1' or name = 'rock_2' and volume < 0"), "rock_1");
  EXPECT_EQ(names("(name = 'rock_1' or name = 'rock_2') and volume < 0"), "");
  EXPECT_EQ(names("not name = 'rock_1' and name like 'rock%'"), "rock_2 rock_3");
  EXPECT_EQ(names("NOT (name = 'rock_1' OR name = 'rock_2')"), "it's rock_3");
  EXPECT_EQ(names("not not name = 'rock_1'"), "rock_1");
}

TEST_F(Query, AMissingDescriptorIsNeitherTrueNorFalse) {
  EXPECT_EQ(names("angularity > 1"), "it's");
  EXPECT_EQ(names("not angularity > 1"), "");
  EXPECT_EQ(names("angularity > 1 or volume > 2.5e-9"), "it's rock_2 rock_3");
}

TEST_F(Query, NoInjection) {
  EXPECT_EQ(names("name = '''; DROP TABLE shapes; --'"), "");
  EXPECT_NE(fault("name = 'a'; DROP TABLE shapes"), "no fault");
  EXPECT_NE(fault("1 = 1) OR (1 = 1"), "no fault");
  EXPECT_EQ(names("1 = 1"), "it's rock_1 rock_2 rock_3");
}

TEST_F(Query, UnknownWordNamesTheNearest) {
  EXPECT_NE(fault("sphericity_wadel > 1").find("'sphericity_wadel'; did you mean 'sphericity_wadell'"),
            std::string::npos);
  EXPECT_NE(fault("volume > 1 and nme = 'x'").find("did you mean 'name'"), std::string::npos);
  EXPECT_NE(fault("volume > 1 and nme = 'x'").find("column 16"), std::string::npos);
  EXPECT_NE(fault("name = rock_1").find("unknown word 'rock_1'"), std::string::npos);
}

TEST_F(Query, FaultsNameTheirPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"volume >", "column 9"},
      {"volume > 1 2", "column 12"},
      {"volume", "column 7"},
      {"(volume > 1", "expected ')'"},
      {"volume > 1)", "column 11"},
      {"and volume > 1", "column 1"},
      {"name like", "column 10"},
      {"name like 5", "like compares texts"},
      {"volume like 'a'", "like compares texts"},
      {"name not = 'a'", "expected like or in after not"},
      {"name in 'a'", "expected '('"},
      {"name in ()", "column 10"},
      {"name in ('a' 'b')", "column 14"},
      {"name in ('a', 5)", "compares a text with a number"},
      {"name > 5", "compares a text with a number"},
      {"volume = '5'", "compares a text with a number"},
      {"name = 'open", "column 8: this quote is not closed"},
      {"volume > 1.2.3", "column 10: expected a number"},
      {"volume > 12mm", "column 10: expected a number"},
      {"volume > 1e999", "column 10: expected a number"},
      {"volume > .", "column 10: expected a number"},
      {"volume ~ 1", "unexpected '~'"},
      {"volume > 1; ", "unexpected ';'"},
      {"volume ! 1", "unexpected '!'"},
  };
  for (const auto& [query, expected] : cases) EXPECT_NE(fault(query).find(expected), std::string::npos) << fault(query);
}

TEST_F(Query, ExtremeQueriesEndInAFault) {
  EXPECT_NE(fault(std::string(100000, '(')).find("nested too deeply"), std::string::npos);
  std::string long_chain = "volume > 0", long_list = "face_count in (0";
  for (int i = 0; i < 1000; ++i) long_chain += " or volume > 0";
  for (int i = 0; i < 20000; ++i) long_list += ",1";
  EXPECT_NE(fault(long_chain).find("too long"), std::string::npos);
  EXPECT_NE(fault(long_list + ")").find("too long"), std::string::npos);
}

// Just inside the parser's own limits SQLite's must not be reached.
TEST_F(Query, LongestAllowedQueriesRun) {
  std::string chain = "volume < 0";
  for (int i = 1; i < 400; ++i) chain += i % 2 ? " or sphericity_wadell < 0" : " and not volume < 0";
  EXPECT_NO_THROW(catalog_->select(chain));
  // As many open operators before each parenthesis as the grammar allows.
  std::string nested = "volume < 0 or volume < 0 and not name not in ('a', 'b')";
  for (int i = 0; i < 5; ++i) nested = "volume < 0 or volume < 0 and not (" + nested + ")";
  EXPECT_NO_THROW(catalog_->select(nested));
  std::string brackets = "sphericity_wadell in (1, 2)";
  for (int i = 0; i < 11; ++i) brackets = "volume < 0 or volume < 0 and (" + brackets + ")";
  EXPECT_NO_THROW(catalog_->select(brackets));
}

TEST(NearestWord, CountsEdits) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("Volume", "volume"), 0u);
  EXPECT_EQ(nearest_word("volum", {"name", "volume"}), "volume");
  EXPECT_EQ(nearest_word("x", {}), std::nullopt);
}

TEST(NearestWord, IsNearInRelationToItsLength) {
  EXPECT_EQ(nearest_word("wlal", {"wall"}), "wall");
  EXPECT_EQ(nearest_word("frictoin", {"friction", "fraction"}), "friction");
  EXPECT_EQ(nearest_word("colour", {"count", "radius"}), std::nullopt);
  EXPECT_EQ(nearest_word("x", {"yz"}), std::nullopt);
  EXPECT_EQ(word_hint("colour", {"count", "radius"}), "known are 'count', 'radius'.");
  EXPECT_EQ(word_hint("volum", {"volume"}), "did you mean 'volume'?");
}

}  // namespace
