// SPDX-License-Identifier: Apache-2.0
// The quick hard cases, one test each; the table of all of them is made by the program hard_cases.
#include <gtest/gtest.h>

#include <cstdio>
#include <ostream>

#include "tests/support/threads.h"
#include "tests/validation/hard_cases/hard_case.h"

namespace hard_cases {

/// What GoogleTest calls a case in its messages and CTest in its list.
void PrintTo(const HardCase& one, std::ostream* out) { *out << one.name; }

}  // namespace hard_cases

namespace {

using hard_cases::HardCase;

std::vector<HardCase> quick_cases() {
  std::vector<HardCase> quick;
  for (HardCase& one : hard_cases::all_cases())
    if (one.is_quick) quick.push_back(std::move(one));
  return quick;
}

class HardCases : public testing::TestWithParam<HardCase> {};

TEST_P(HardCases, Hold) {
  // Few bodies each: more threads only wait for one another.
  const test_support::ThreadLimit one_thread(1);
  const hard_cases::Finding finding = GetParam().run();
  std::printf("  %s: %s\n", GetParam().criterion.c_str(), finding.got.c_str());
  EXPECT_TRUE(finding.holds) << GetParam().criterion << "; got " << finding.got;
}

std::string test_name(const testing::TestParamInfo<HardCase>& info) {
  std::string name;
  bool starts_word = true;
  for (const char letter : info.param.name) {
    if (std::isalnum(static_cast<unsigned char>(letter)))
      name += starts_word ? static_cast<char>(std::toupper(letter)) : letter;
    starts_word = !std::isalnum(static_cast<unsigned char>(letter));
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Quick, HardCases, testing::ValuesIn(quick_cases()), test_name);

}  // namespace
