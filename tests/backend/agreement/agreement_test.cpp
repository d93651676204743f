// SPDX-License-Identifier: Apache-2.0
// A back end agrees with itself, and what differs is told.
#include <gtest/gtest.h>

#include <functional>

#include "catalog/input_error.h"
#include "tests/backend/agreement/comparison.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/threads.h"

namespace {

using namespace agreement;

/// Written by one thread and read again.
Outcome written_by_one_thread(const Case& one) {
  const test_support::ThreadLimit single(1);
  const test_support::TemporaryFolder folder;
  write_outcome(folder.path(), one, outcome_from(one, settled(one)));
  return read_outcome(folder.path(), one);
}

std::vector<std::string> differing(const Outcome& reference, const Outcome& own) {
  std::vector<std::string> what;
  for (const Agreement& row : compare(reference, own))
    if (!row.holds()) what.push_back(row.what);
  return what;
}

TEST(Agreement, HoldsOnTwoThreadsAndNotWithAnAlteredReference) {
  const Case one = cases().front();
  const Outcome reference = written_by_one_thread(one);
  Outcome own = outcome_from(one, reference.start);
  {
    const test_support::ThreadLimit two(2);
    own.after_one = after_steps(one, reference.start, 1);
    own.after_many = after_steps(one, reference.start, kManySteps);
  }
  EXPECT_TRUE(differing(reference, own).empty());
  EXPECT_GT(reference.after_one.contacts.size(), reference.start.position.size()) << "bodies touch";

  using Names = std::vector<std::string>;
  const auto altered = [&](const std::function<void(Outcome&)>& alter) {
    Outcome other = reference;
    alter(other);
    return differing(other, own);
  };
  EXPECT_EQ(altered([](Outcome& o) { o.after_one.velocity[7].x += 1e-6; }), Names{"velocity, one step"});
  EXPECT_EQ(altered([](Outcome& o) { o.after_one.position[7].x += 1e-9; }), Names{"position, one step"});
  EXPECT_EQ(altered([](Outcome& o) { o.after_many.contacts.pop_back(); }), Names{"contact force, 10 steps"});
  EXPECT_EQ(altered([](Outcome& o) { o.after_many.orientation.pop_back(); }), Names{"orientation, 10 steps"});
  EXPECT_EQ(altered([](Outcome& o) {
              for (Bulk& bulk : o.bulks) bulk.coordination *= 1.1;
            }),
            Names{"coordination, t"});
  EXPECT_EQ(altered([](Outcome& o) { o.after_one.velocity[7].x = NAN; }), Names{"velocity, one step"});
}

TEST(Agreement, SeesAnotherFriction) {
  Case one = cases().front();
  Outcome reference{settled(one), {}, {}, std::vector<Bulk>(std::size(kSeeds))};
  Outcome own = reference;
  const auto step_both = [&](Outcome& outcome) {
    outcome.after_one = after_steps(one, reference.start, 1);
    outcome.after_many = after_steps(one, reference.start, kManySteps);
  };
  step_both(reference);
  one.scene.contact[0][0].friction_coefficient *= 0.99;
  step_both(own);
  const std::vector<std::string> what = differing(reference, own);
  EXPECT_NE(std::find(what.begin(), what.end(), "velocity, 10 steps"), what.end());
}

TEST(Agreement, MissingReferenceIsNamed) {
  const test_support::TemporaryFolder empty;
  try {
    read_outcome(empty.path(), cases().front());
    FAIL();
  } catch (const catalog::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("start.h5"), std::string::npos);
  }
}

}  // namespace
