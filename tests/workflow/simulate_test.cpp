// SPDX-License-Identifier: Apache-2.0
// talus-simulate as a program: a small drum of boxes and balls, its files, resuming, stopping, refusals.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/scene_text.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::drum_scene;
using test_support::read_bytes;
using test_support::with;

/// A talus-simulate that was started, its two outputs going to files.
class StartedProgram {
 public:
  StartedProgram(const fs::path& folder, std::vector<std::string> arguments)
      : out_(folder / "stdout.txt"), error_(folder / "stderr.txt") {
    arguments.insert(arguments.begin(), TALUS_SIMULATE);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_.c_str(), flags, 0644);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, error_.c_str(), flags, 0644);
    if (posix_spawn(&process_, argv[0], &actions, nullptr, argv.data(), environ) != 0)
      throw std::runtime_error("cannot start " + arguments[0]);
    posix_spawn_file_actions_destroy(&actions);
  }

  void send(int signal) const { kill(process_, signal); }

  int exit_status() {
    int status = 0;
    waitpid(process_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string out() const { return read_bytes(out_); }
  std::string error() const { return read_bytes(error_); }

 private:
  fs::path out_, error_;
  pid_t process_ = 0;
};

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Byte by byte, and not empty.
bool is_same(const fs::path& a, const fs::path& b) {
  const std::string bytes = read_bytes(a);
  return !bytes.empty() && bytes == read_bytes(b);
}

/// The text without the last column of each row.
std::string without_last_column(const std::string& csv) {
  std::istringstream lines(csv);
  std::string rest;
  for (std::string line; std::getline(lines, line);) rest += line.substr(0, line.rfind(',')) + "\n";
  return rest;
}

class Simulate : public testing::Test {
 protected:
  Simulate() { test_support::write_bytes(scene_, drum_scene()); }

  int run(std::vector<std::string> arguments) {
    StartedProgram program(folder_.path(), std::move(arguments));
    const int status = program.exit_status();
    out_ = program.out();
    error_ = program.error();
    return status;
  }

  nlohmann::json json(const fs::path& file) const { return nlohmann::json::parse(read_bytes(file)); }

  test_support::TemporaryFolder folder_;
  const fs::path scene_ = folder_ / "drum.toml", runs_ = folder_ / "runs", run_ = runs_ / "drum";
  std::string out_, error_;
};

TEST_F(Simulate, LeavesAWholeRunFolder) {
  ASSERT_EQ(run({scene_.string()}), 0) << error_;
  EXPECT_EQ(out_, run_.string() + "\n");
  // 40 ms, every 10 ms from 0.
  for (int number = 0; number <= 4; ++number)
    EXPECT_TRUE(fs::exists(run_ / "snapshots" / ("snapshot_00000" + std::to_string(number) + ".h5"))) << number;
  for (const char* name : {"scene.toml", "resolved_scene.json", "geometry.h5", "checkpoint.h5", "run.log"})
    EXPECT_TRUE(fs::exists(run_ / name)) << name;
  // Every 5 ms from 0: header and 9 rows; 7 walls in each.
  EXPECT_EQ(line_count(read_bytes(run_ / "time_series.csv")), 1u + 9);
  EXPECT_EQ(line_count(read_bytes(run_ / "walls.csv")), 1u + 9 * 7);
  EXPECT_EQ(read_bytes(run_ / "time_series.csv").rfind("time[s],step[-],active_bodies[-],active_mass[kg],", 0), 0u);
  EXPECT_GT(line_count(read_bytes(run_ / "ledger.csv")), 9u);

  const nlohmann::json summary = json(run_ / "run.json"), resolved = json(run_ / "resolved_scene.json");
  EXPECT_TRUE(summary.at("finished").get<bool>());
  EXPECT_NEAR(summary.at("simulated_time").get<double>(), 0.04, summary.at("time_step").get<double>());
  EXPECT_NEAR(summary.at("steps").get<double>() * summary.at("time_step").get<double>(),
              summary.at("simulated_time").get<double>(), 1e-12);
  EXPECT_LT(summary.at("energy").at("imbalance_share").get<double>(), 0.02);
  for (const char* key : {"backend", "precision", "wall_seconds", "dissipation", "quality", "shapes", "passes",
                          "command", "tool_version", "warnings"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_EQ(resolved.at("walls").size(), 7u);
  EXPECT_EQ(resolved.at("run").at("time_step"), summary.at("time_step"));
  EXPECT_GT(resolved.at("contact_law").at("polyhedra").at("stiffness").get<double>(), 0);

  // A finished run is never written over.
  const std::string before = read_bytes(run_ / "run.json");
  EXPECT_EQ(run({scene_.string()}), 3);
  EXPECT_NE(error_.find("--resume"), std::string::npos) << error_;
  EXPECT_EQ(read_bytes(run_ / "run.json"), before);
}

TEST_F(Simulate, AResumedRunEndsInTheSameBytes) {
  const fs::path whole = folder_ / "whole", halves = folder_ / "halves";
  ASSERT_EQ(run({scene_.string(), "--out", whole.string()}), 0) << error_;
  ASSERT_EQ(run({scene_.string(), "--out", halves.string(), "--end-time", "17 ms"}), 0) << error_;
  ASSERT_EQ(run({"--resume", halves.string(), "--end-time", "40 ms"}), 0) << error_;
  std::size_t snapshots = 0;
  for (const auto& entry : fs::directory_iterator(whole / "snapshots")) {
    ++snapshots;
    EXPECT_TRUE(is_same(entry.path(), halves / "snapshots" / entry.path().filename())) << entry.path();
  }
  EXPECT_EQ(snapshots, 5u);
  EXPECT_TRUE(json(halves / "run.json").at("finished").get<bool>());
}

TEST_F(Simulate, TermStopsAtACheckpointAndTheResumedRunIsTheSame) {
  // Long enough that the signal comes in the middle.
  test_support::write_bytes(scene_, with(drum_scene(), "end_time = \"40 ms\"", "end_time = \"400 ms\""));
  const fs::path whole = folder_ / "whole";
  ASSERT_EQ(run({scene_.string(), "--out", whole.string()}), 0) << error_;

  StartedProgram program(folder_.path(), {scene_.string()});
  while (!fs::exists(run_ / "snapshots" / "snapshot_000002.h5"))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  program.send(SIGTERM);
  ASSERT_EQ(program.exit_status(), 75) << program.error();
  EXPECT_NE(program.error().find("resumable with talus simulate --resume " + run_.string()), std::string::npos);
  EXPECT_FALSE(json(run_ / "run.json").at("finished").get<bool>());

  ASSERT_EQ(run({scene_.string(), "--resume"}), 0) << error_;
  for (const char* name : {"snapshot_000010.h5", "snapshot_000040.h5"})
    EXPECT_TRUE(is_same(whole / "snapshots" / name, run_ / "snapshots" / name)) << name;
  // All but the speed of the computer.
  EXPECT_EQ(without_last_column(read_bytes(whole / "time_series.csv")),
            without_last_column(read_bytes(run_ / "time_series.csv")));
  EXPECT_EQ(line_count(read_bytes(whole / "walls.csv")), line_count(read_bytes(run_ / "walls.csv")));
}

TEST_F(Simulate, InterruptIsResumableToo) {
  test_support::write_bytes(scene_, with(drum_scene(), "end_time = \"40 ms\"", "end_time = \"100 s\""));
  StartedProgram program(folder_.path(), {scene_.string()});
  while (!fs::exists(run_ / "snapshots" / "snapshot_000001.h5"))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  program.send(SIGINT);
  EXPECT_EQ(program.exit_status(), 130) << program.error();
  EXPECT_TRUE(fs::exists(run_ / "checkpoint.h5"));
}

TEST_F(Simulate, DryRunWritesNothing) {
  EXPECT_EQ(run({scene_.string(), "--dry-run"}), 0) << error_;
  EXPECT_NE(out_.find("18 bodies"), std::string::npos) << out_;
  EXPECT_NE(out_.find("steps to 0.04 s"), std::string::npos) << out_;
  EXPECT_FALSE(fs::exists(runs_));
  EXPECT_EQ(run({scene_.string(), "--dry-run", "--json"}), 0) << error_;
  EXPECT_EQ(nlohmann::json::parse(out_).at("bodies").at("count"), 18);
}

TEST_F(Simulate, BadInputExitsWithThreeAndLeavesNothing) {
  const auto expect_refused = [&](const std::string& text, const std::string& part) {
    test_support::write_bytes(scene_, text);
    EXPECT_EQ(run({scene_.string()}), 3) << error_;
    EXPECT_NE(error_.find(part), std::string::npos) << error_;
    EXPECT_EQ(line_count(error_), 1u) << error_;
    EXPECT_FALSE(fs::exists(runs_));
  };
  expect_refused(with(drum_scene(), "friction = 0.5", "frictoin = 0.5"), "nearest known key: 'friction'");
  expect_refused(with(drum_scene(), "end_time = \"40 ms\"", "end_time = \"40 ms\"\ntime_step = \"1 ms\""),
                 "drum.toml:4:1: run: time step");
  expect_refused(with(drum_scene(), "snapshot_every = \"10 ms\"", "snapshot_every = \"1 ns\""), "snapshot_every");
  expect_refused(
      with(drum_scene(), "box = {size = [\"10 mm\", \"12 mm\", \"14 mm\"]}", "shapes_from = \"no.talus\"\nparts = 2"),
      "no.talus");
  expect_refused("", "is empty");
  EXPECT_EQ(run({(folder_ / "missing.toml").string()}), 3);
  EXPECT_NE(error_.find("no such file"), std::string::npos) << error_;
  EXPECT_EQ(run({scene_.string(), "--out", "/dev/null/run"}), 3);
  EXPECT_EQ(run({"--resume", folder_.path().string()}), 3);
  EXPECT_NE(error_.find("holds no run to resume"), std::string::npos) << error_;
}

TEST_F(Simulate, AChangedSceneIsNotResumed) {
  ASSERT_EQ(run({scene_.string(), "--end-time", "5 ms"}), 0) << error_;
  test_support::write_bytes(scene_, with(drum_scene(), "count = 12", "count = 11"));
  EXPECT_EQ(run({scene_.string(), "--resume"}), 3);
  EXPECT_NE(error_.find("differs from the scene"), std::string::npos) << error_;
  // A damaged copy is caught by the checkpoint, which knows its scene.
  test_support::write_bytes(run_ / "scene.toml", with(drum_scene(), "count = 12", "count = 11"));
  EXPECT_EQ(run({"--resume", run_.string()}), 3);
  EXPECT_NE(error_.find("another scene"), std::string::npos) << error_;
}

TEST_F(Simulate, TwoProcessesDoNotRunOneFolder) {
  test_support::write_bytes(scene_, with(drum_scene(), "end_time = \"40 ms\"", "end_time = \"100 s\""));
  const fs::path first_folder = folder_ / "first";
  fs::create_directory(first_folder);
  StartedProgram first(first_folder, {scene_.string()});
  while (!fs::exists(run_ / "snapshots" / "snapshot_000001.h5"))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(run({"--resume", run_.string()}), 3);
  EXPECT_NE(error_.find("is being run by another process"), std::string::npos) << error_;
  first.send(SIGINT);
  EXPECT_EQ(first.exit_status(), 130) << first.error();
  // Free again: past the lock, to the next thing wrong.
  EXPECT_EQ(run({"--resume", run_.string(), "--end-time", "1 ms"}), 3);
  EXPECT_NE(error_.find("give a later --end-time"), std::string::npos) << error_;
}

TEST_F(Simulate, EndTimesOutOfReachAreRefused) {
  for (const char* time : {"1e300 s", "1e12 s", "1e-12 s"}) {
    EXPECT_EQ(run({scene_.string(), "--end-time", time}), 3) << time;
    EXPECT_NE(error_.find("run.end_time"), std::string::npos) << error_;
  }
  for (const char* time : {"0 s", "-1 s"}) {
    EXPECT_EQ(run({scene_.string(), "--end-time", time}), 2) << time;
    EXPECT_NE(error_.find("is not above 0"), std::string::npos) << error_;
  }
  EXPECT_FALSE(fs::exists(runs_));
  ASSERT_EQ(run({scene_.string()}), 0) << error_;
  const std::string resolved = read_bytes(run_ / "resolved_scene.json");
  EXPECT_EQ(run({"--resume", run_.string(), "--end-time", "20 ms"}), 3);
  EXPECT_NE(error_.find("give a later --end-time"), std::string::npos) << error_;
  EXPECT_EQ(read_bytes(run_ / "resolved_scene.json"), resolved);
}

// Checkpoints at 20 ms and 40 ms: with the second one lost, the run goes on from the first, and no output of the lost
// part stays.
TEST_F(Simulate, GoesOnFromThePreviousCheckpointAndSaysSo) {
  ASSERT_EQ(run({scene_.string()}), 0) << error_;
  const fs::path last = run_ / "snapshots" / "snapshot_000004.h5";
  test_support::write_bytes(run_ / "checkpoint.h5", "half a checkpoint");
  ASSERT_EQ(run({"--resume", run_.string(), "--end-time", "30 ms"}), 0) << error_;
  EXPECT_NE(error_.find("went on from checkpoint_previous.h5"), std::string::npos) << error_;
  EXPECT_NE(read_bytes(run_ / "run.log").find("went on from checkpoint_previous.h5"), std::string::npos);
  EXPECT_FALSE(fs::exists(last));
  EXPECT_TRUE(fs::exists(run_ / "snapshots" / "snapshot_000003.h5"));
}

TEST_F(Simulate, AResumedRunMendsItsFolderAndSaysWhatIsLost) {
  ASSERT_EQ(run({scene_.string(), "--end-time", "20 ms"}), 0) << error_;
  const fs::path geometry = run_ / "geometry.h5";
  const std::string whole = read_bytes(geometry);
  fs::remove_all(run_ / "snapshots");
  fs::remove(geometry);
  fs::remove(run_ / "walls.csv");
  const std::string series = read_bytes(run_ / "time_series.csv");
  test_support::write_bytes(run_ / "time_series.csv", series.substr(0, series.size() / 2));
  ASSERT_EQ(run({"--resume", run_.string(), "--end-time", "30 ms"}), 0) << error_;
  const std::string log = read_bytes(run_ / "run.log");
  for (const char* part : {"geometry.h5: no such file", "snapshots: 3 of the 3 snapshots so far are missing",
                           "walls.csv: was missing", "time_series.csv: ends at "}) {
    EXPECT_NE(error_.find(part), std::string::npos) << part << ": " << error_;
    EXPECT_NE(log.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(read_bytes(geometry), whole);
  EXPECT_TRUE(fs::exists(run_ / "snapshots" / "snapshot_000003.h5"));
  // A whole folder needs no mending; a damaged file does.
  ASSERT_EQ(run({"--resume", run_.string(), "--end-time", "32 ms"}), 0) << error_;
  EXPECT_EQ(error_.find("geometry.h5"), std::string::npos) << error_;
  test_support::write_bytes(geometry, whole.substr(0, whole.size() / 2));
  ASSERT_EQ(run({"--resume", run_.string(), "--end-time", "34 ms"}), 0) << error_;
  EXPECT_NE(error_.find("it was made again from the scene"), std::string::npos) << error_;
  EXPECT_EQ(read_bytes(geometry), whole);
}

TEST_F(Simulate, AFolderInAFilesPlaceIsNamedOnResume) {
  ASSERT_EQ(run({scene_.string(), "--end-time", "5 ms"}), 0) << error_;
  for (const char* file : {"walls.csv", "time_series.csv", "run.json"}) {
    const std::string bytes = read_bytes(run_ / file);
    fs::remove(run_ / file);
    fs::create_directory(run_ / file);
    EXPECT_EQ(run({"--resume", run_.string(), "--end-time", "6 ms"}), 1) << file;
    EXPECT_NE(error_.find((run_ / file).string() + ": cannot be replaced: it is a folder; move it out of the way"),
              std::string::npos)
        << error_;
    fs::remove(run_ / file);
    test_support::write_bytes(run_ / file, bytes);
  }
  fs::remove(run_ / "checkpoint.h5");
  fs::create_directory(run_ / "checkpoint.h5");
  EXPECT_EQ(run({"--resume", run_.string(), "--end-time", "7 ms"}), 3);
  EXPECT_NE(error_.find("checkpoint.h5: is no file; expected a Talus"), std::string::npos) << error_;
}

TEST_F(Simulate, ADamagedResolvedSceneIsBadInput) {
  ASSERT_EQ(run({scene_.string(), "--end-time", "5 ms"}), 0) << error_;
  const nlohmann::json whole = json(run_ / "resolved_scene.json");
  for (const char* key : {"name", "scene_folder", "run"}) {
    nlohmann::json damaged = whole;
    damaged[key] = 7;
    test_support::write_bytes(run_ / "resolved_scene.json", damaged.dump());
    EXPECT_EQ(run({"--resume", run_.string()}), 3) << key;
    EXPECT_NE(error_.find("resolved_scene.json"), std::string::npos) << error_;
  }
}

TEST_F(Simulate, UsageErrorsExitWithTwo) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"--no-such-option"}), 2);
  EXPECT_EQ(run({scene_.string(), "--end-time", "3 apples"}), 2);
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_EQ(out_.rfind("Example: talus simulate", 0), 0u) << out_;
}

}  // namespace
