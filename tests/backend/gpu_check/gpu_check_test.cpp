// SPDX-License-Identifier: Apache-2.0
// Whatever passes, fails, hangs or is missing is in the JSON.
#include <gtest/gtest.h>

#include <fstream>

#include "catalog/input_error.h"
#include "tests/backend/gpu_check/stages.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace gpu_check;

/// A folder with programs that are scripts.
class GpuCheck : public testing::Test {
 protected:
  test_support::TemporaryFolder temporary;
  Place place{temporary.path(), temporary / "logs"};

  void SetUp() override {
    for (const char* folder : {"tests", "bin", "logs"}) fs::create_directories(place.folder / folder);
  }
  void add_program(const std::string& name, const std::string& script) {
    test_support::write_bytes(place.folder / name, "#!/bin/sh\n" + script + "\n");
    fs::permissions(place.folder / name, fs::perms::owner_all);
  }
  /// A test program with one test, in the first shard alone; `result` as GoogleTest writes it.
  void add_test(const std::string& name, const std::string& result, int status) {
    const std::string report = R"({"testsuites":[{"name":"Suite","testsuite":[{"name":"Case",)" + result + "}]}]}";
    add_program("tests/" + name, "if [ $GTEST_SHARD_INDEX = 0 ]; then echo '" + report +
                                     "' > ${1#--gtest_output=json:}; exit " + std::to_string(status) + "; fi");
  }
  Json row_of_test(const std::string& name, double budget = 20) {
    return run_tests(place, {{name, "unit"}}, budget).at(0);
  }
};

TEST_F(GpuCheck, TestsThatPassFailAndSkip) {
  add_test("good", R"("result":"COMPLETED")", 0);
  EXPECT_EQ(row_of_test("good").at("result"), "passed");
  EXPECT_EQ(row_of_test("good").at("tests"), 1);
  add_test("bad", R"("result":"COMPLETED","failures":[{"failure":"no"}])", 1);
  EXPECT_EQ(row_of_test("bad").at("result"), "failed");
  EXPECT_EQ(row_of_test("bad").at("failures"), Json::array({"Suite.Case"}));
  add_test("skips", R"("result":"SKIPPED")", 0);
  EXPECT_EQ(row_of_test("skips").at("skipped"), Json::array({"Suite.Case"}));
}

TEST_F(GpuCheck, TestsThatHangCrashOrAreMissing) {
  add_program("tests/hangs", "echo '[ RUN      ] Suite.Slow'; sleep 30 & sleep 30");
  const Json hanging = row_of_test("hangs", 0.5);
  EXPECT_EQ(hanging.at("result"), "timed out");
  EXPECT_NE(hanging.at("why").get<std::string>().find("Suite.Slow"), std::string::npos);
  EXPECT_LT(hanging.at("seconds"), 10);
  add_program("tests/crashes", "kill -SEGV $$");
  EXPECT_EQ(row_of_test("crashes").at("result"), "failed");
  EXPECT_EQ(row_of_test("missing").at("result"), "failed");
  add_program("tests/empty", "exit 0");
  EXPECT_EQ(row_of_test("empty").at("result"), "not run");
  EXPECT_EQ(row_of_test("empty", 0).at("result"), "not run");
}

TEST_F(GpuCheck, BenchesKeepTheWindowsTheyFinished) {
  add_program("bin/time_scene",
              "echo '2000 bodies begin'\n"
              "echo '10 steps, 0.5 ms each, 1 ms of processors'; echo '10 steps, 0.2 ms each, 1 ms of processors'\n"
              "[ $1 = slow ] && sleep 30\n"
              "echo '10 steps, 0.4 ms each, 1 ms of processors'\n"
              "echo 'time 0.6 s, 2000 bodies, 4000 contacts (3.5 bodies touch one), mean height 0.1 m'");
  const Json rows = run_benches(place, {{"quick", 20, {"quick"}}, {"slow", 0.5, {"slow"}}}, 30);
  EXPECT_EQ(rows[0].at("result"), "passed");
  EXPECT_EQ(rows[0].at("ms per step"), (Json{{"median", 0.4}, {"least", 0.2}, {"most", 0.5}}));
  EXPECT_DOUBLE_EQ(rows[0].at("particle-steps per second"), 2000 / 0.4e-3);
  EXPECT_EQ(rows[0].at("contacts"), 4000);
  EXPECT_EQ(rows[1].at("result"), "timed out");
  EXPECT_EQ(rows[1].at("windows"), 2);
  EXPECT_EQ(rows[1].at("bodies"), 2000);
  EXPECT_EQ(run_benches(place, {{"late", 20, {"quick"}}}, 0)[0].at("result"), "not run");
}

TEST_F(GpuCheck, AgreementThatDiffersHasFailed) {
  add_program("bin/agreement", "echo '[{\"agrees\": false}]' > $4; echo cubes differ; exit 4");
  const Json row = run_agreement(place, 20);
  EXPECT_EQ(row.at("result"), "failed");
  EXPECT_EQ(row.at("why"), "status 4: cubes differ");
  EXPECT_EQ(row.at("figures").size(), 1u);
}

TEST_F(GpuCheck, PlansAreReadAndBadLinesNamed) {
  EXPECT_GT(read_benches(GPU_CHECK_BENCHES).size(), 10u);
  test_support::write_bytes(place.folder / "tests.txt", "# tests\none unit\ntwo\n");
  try {
    read_tests(place.folder / "tests.txt");
    FAIL();
  } catch (const catalog::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("tests.txt:3: expected NAME LABEL"), std::string::npos);
  }
  EXPECT_THROW(read_benches(place.folder / "benches.txt"), catalog::InputError);
}

/// The program itself, where it has no device or is told to do without.
TEST_F(GpuCheck, ExitStatusSaysWhatHappened) {
#if defined(TALUS_BACKEND_CUDA)
  GTEST_SKIP() << "this build may have a device";
#endif
  add_test("bad", R"("result":"COMPLETED","failures":[{"failure":"no"}])", 1);
  add_program("bin/agreement", "exit 0");
  add_program("bin/time_scene", "exit 1");
  test_support::write_bytes(place.folder / "benches.txt", "s1 20 s1-box\n");
  const fs::path out = place.folder / "out.json";
  const auto status_of = [&](const std::string& more) {
    return run_all({{{GPU_CHECK, place.folder.string(), out.string(), more}, {}, place.logs / "out.log", 60}}, 1, 60)[0]
        .status;
  };
  test_support::write_bytes(place.folder / "tests.txt", "bad unit\n");
  EXPECT_EQ(status_of("--without-device"), 4);
  Json report = Json::parse(text_of(out));
  EXPECT_EQ(report.at("passed"), false);
  EXPECT_EQ(report.at("did not pass"), Json::array({"bad: failed, Suite.Case"}));
  EXPECT_NE(report.at("not run or cut short").dump().find("bench s1: failed"), std::string::npos);
  add_test("bad", R"("result":"COMPLETED")", 0);
  EXPECT_EQ(status_of("--without-device"), 0);
  const Ending ending =
      run_all({{{GPU_CHECK, place.folder.string(), out.string()}, {}, place.logs / "out.log", 60}}, 1, 60)[0];
  EXPECT_EQ(ending.status, 5);
  report = Json::parse(text_of(out));
  EXPECT_EQ(report.at("device"), nullptr);
  EXPECT_EQ(report.at("passed"), false);
}

}  // namespace
