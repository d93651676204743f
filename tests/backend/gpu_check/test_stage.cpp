// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "tests/backend/gpu_check/stages.h"

namespace gpu_check {
namespace {

namespace fs = std::filesystem;

// Tests mostly wait for launches and for the CPU, so several fit on one device.
constexpr int kShards = 4;
constexpr unsigned kMostBeside = 8;

std::string shard_name(const TestProgram& test, int shard) { return test.name + "." + std::to_string(shard); }

Command command_of(const Place& place, const TestProgram& test, int shard, double limit) {
  const std::string name = shard_name(test, shard);
  return {{(place.folder / "tests" / test.name).string(),
           "--gtest_output=json:" + (place.logs / (name + ".json")).string()},
          {"GTEST_TOTAL_SHARDS=" + std::to_string(kShards), "GTEST_SHARD_INDEX=" + std::to_string(shard),
           "TALUS_SIMULATE=" + (place.folder / "bin" / "talus-simulate").string()},
          place.logs / (name + ".log"),
          limit};
}

/// The test that was running when the log ended; empty if none was.
std::string running_test(const std::string& log) {
  constexpr std::string_view kRun = "[ RUN      ] ";
  std::string running;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kRun))
      running = line.substr(kRun.size());
    else if (line.starts_with("[       OK ]") || line.starts_with("[  FAILED  ]") || line.starts_with("[  SKIPPED ]"))
      running.clear();
  }
  return running;
}

/// Adds what GoogleTest wrote about a shard to the row.
void add_shard(const Json& report, Json& row) {
  for (const Json& suite : report.at("testsuites"))
    for (const Json& test : suite.at("testsuite")) {
      const std::string name = suite.at("name").get<std::string>() + "." + test.at("name").get<std::string>();
      row["tests"] = row["tests"].get<int>() + 1;
      if (test.contains("failures")) row["failures"].push_back(name);
      if (test.at("result") == "SKIPPED") row["skipped"].push_back(name);
    }
}

/// The worse of two results.
std::string worse(const std::string& a, const std::string& b) {
  constexpr std::string_view kOrder[] = {"passed", "not run", "timed out", "failed"};
  const auto rank = [&](const std::string& one) { return std::find(std::begin(kOrder), std::end(kOrder), one); };
  return rank(a) < rank(b) ? b : a;
}

Json row_of(const Place& place, const TestProgram& test, const Ending* shards) {
  Json row{{"name", test.name}, {"label", test.label},       {"result", "passed"},      {"seconds", 0.0},
           {"tests", 0},        {"failures", Json::array()}, {"skipped", Json::array()}};
  for (int shard = 0; shard < kShards; ++shard) {
    const fs::path report = place.logs / (shard_name(test, shard) + ".json");
    row["seconds"] = row["seconds"].get<double>() + shards[shard].seconds;
    row["result"] = worse(row["result"], result_of(shards[shard]));
    if (fs::exists(report)) add_shard(Json::parse(text_of(report)), row);
    const std::string running = running_test(text_of(place.logs / (shard_name(test, shard) + ".log")));
    if (!running.empty())
      row["why"] = row.value("why", "") + "ended in " + running + " (status " + std::to_string(shards[shard].status) +
                   ", shard " + std::to_string(shard) + "); ";
  }
  if (row["result"] == "passed" && row["tests"] == 0) {
    row["result"] = "not run";
    row["why"] = "the program has no tests";
  }
  return row;
}

}  // namespace

std::string result_of(const Ending& ending) {
  if (!ending.started) return "not run";
  if (ending.timed_out) return "timed out";
  return ending.status == 0 ? "passed" : "failed";
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

Json run_tests(const Place& place, const std::vector<TestProgram>& tests, double budget) {
  std::vector<Command> commands;
  for (const TestProgram& test : tests)
    for (int shard = 0; shard < kShards; ++shard) commands.push_back(command_of(place, test, shard, budget));
  const int beside = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, kMostBeside));
  const std::vector<Ending> endings = run_all(commands, beside, budget);
  Json rows = Json::array();
  for (std::size_t i = 0; i < tests.size(); ++i) rows.push_back(row_of(place, tests[i], &endings[i * kShards]));
  return rows;
}

}  // namespace gpu_check
