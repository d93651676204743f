// SPDX-License-Identifier: Apache-2.0
#include "workflows/stage_tool.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "catalog/input_error.h"

namespace {

using namespace workflows;

struct Outcome {
  int status;
  std::string on_stderr;
};

template <class Body>
Outcome run(const std::string& stage, Body body) {
  testing::internal::CaptureStderr();
  const int status = run_stage(stage, body);
  return {status, testing::internal::GetCapturedStderr()};
}

TEST(RunStage, PassesTheStatusOn) {
  EXPECT_EQ(run("post", [] { return kDone; }).status, 0);
  EXPECT_EQ(run("post", [] { return kCheckNotPassed; }).status, 4);
  EXPECT_EQ(run("post", [] { return kResumable; }).status, 75);
  EXPECT_EQ(run("post", [] { return kDone; }).on_stderr, "");
}

TEST(RunStage, TurnsErrorsIntoOneLineAndAStatus) {
  const Outcome input = run("post", []() -> int { throw catalog::InputError("a.ply: is empty"); });
  EXPECT_EQ(input.status, 3);
  EXPECT_EQ(input.on_stderr, "talus post: bad input: a.ply: is empty\n");
  const Outcome usage = run("post", []() -> int { throw catalog::UsageError("--to needs a file"); });
  EXPECT_EQ(usage.status, 2);
  EXPECT_EQ(usage.on_stderr, "talus post: usage: --to needs a file\n");
  const Outcome failed = run("post", []() -> int { throw std::runtime_error("disk full"); });
  EXPECT_EQ(failed.status, 1);
  EXPECT_EQ(failed.on_stderr, "talus post: failed: disk full\n");
  EXPECT_EQ(run("", []() -> int { throw std::runtime_error("x"); }).on_stderr, "talus: failed: x\n");
}

TEST(RunStage, DoesNotSwallowWhatIsNoException) {
  EXPECT_THROW(run_stage("post", []() -> int { throw 7; }), int);
}

TEST(ToolVersion, NamesTheProgram) { EXPECT_EQ(tool_version(), std::string("talus ") + TALUS_VERSION); }

TEST(BatchProgress, OneLineAnItemWhereStderrIsNoTerminal) {
  testing::internal::CaptureStderr();
  BatchProgress progress("digitize", 2);
  progress.step("a.ply");
  progress.note("a.ply is open");
  progress.step("b.ply");
  progress.finish();
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "digitize: [1/2] a.ply\ndigitize: a.ply is open\ndigitize: [2/2] b.ply\n");
}

}  // namespace
