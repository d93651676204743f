// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "tests/backend/gpu_check/stages.h"

namespace gpu_check {
namespace {

namespace fs = std::filesystem;

/// The last line that is not empty: where programs say what went wrong.
std::string last_line(const std::string& text) {
  std::string last;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return last;
}

Ending run_one(const Command& command) { return run_all({command}, 1, command.limit)[0]; }

void say_why(Json& row, const Ending& ending, const fs::path& log) {
  if (row.at("result") == "not run") row["why"] = "no time was left, or it could not be started";
  if (row.at("result") == "timed out") row["why"] = "stopped after " + std::to_string(ending.seconds) + " s";
  if (row.at("result") == "failed")
    row["why"] = "status " + std::to_string(ending.status) + ": " + last_line(text_of(log));
}

/// What time_scene printed.
void add_figures(const std::string& output, Json& row) {
  std::vector<double> windows;  // ms a step
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    long long steps = 0;
    double milliseconds = 0, time = 0, of_pairs = 0;
    int bodies = 0, contacts = 0;
    if (std::sscanf(line.c_str(), "%lld steps, %lf ms each,", &steps, &milliseconds) == 2)
      windows.push_back(milliseconds);
    if (line.ends_with(" bodies begin")) row["bodies"] = std::atoi(line.c_str());
    if (std::sscanf(line.c_str(), "time %lf s, %d bodies, %d contacts (%lf", &time, &bodies, &contacts, &of_pairs) ==
        4) {
      row["bodies"] = bodies;
      row["contacts"] = contacts;
      row["bodies that touch one"] = of_pairs;
    }
  }
  row["windows"] = windows.size();
  if (windows.empty()) return;
  std::sort(windows.begin(), windows.end());
  const double median = windows[windows.size() / 2];
  row["ms per step"] = {{"median", median}, {"least", windows.front()}, {"most", windows.back()}};
  if (row.contains("bodies")) row["particle-steps per second"] = row["bodies"].get<double>() / median * 1e3;
}

/// Its path, or empty.
std::string find_sanitizer() {
  std::string folders = "/usr/local/cuda/bin";
  if (const char* path = std::getenv("PATH")) folders = path + (":" + folders);
  std::istringstream parts(folders);
  for (std::string folder; std::getline(parts, folder, ':');)
    if (const std::string file = folder + "/compute-sanitizer"; access(file.c_str(), X_OK) == 0) return file;
  return "";
}

}  // namespace

Json run_agreement(const Place& place, double budget) {
  const fs::path json = place.logs / "agreement.json", log = place.logs / "agreement.log";
  const Ending ending = run_one({{(place.folder / "bin" / "agreement").string(), "--compare",
                                  (place.folder / "reference").string(), "--json", json.string()},
                                 {},
                                 log,
                                 budget});
  Json row{{"result", result_of(ending)}, {"seconds", ending.seconds}};
  say_why(row, ending, log);
  if (fs::exists(json)) row["figures"] = Json::parse(text_of(json));
  return row;
}

Json run_benches(const Place& place, const std::vector<Bench>& benches, double budget) {
  Json rows = Json::array();
  double left = budget;
  for (const Bench& bench : benches) {
    const fs::path log = place.logs / (bench.name + ".log");
    std::vector<std::string> words{(place.folder / "bin" / "time_scene").string()};
    words.insert(words.end(), bench.arguments.begin(), bench.arguments.end());
    const Ending ending = run_one({words, {}, log, std::min(left, bench.limit)});
    left -= ending.seconds;
    Json row{{"name", bench.name},
             {"arguments", bench.arguments},
             {"result", result_of(ending)},
             {"seconds", ending.seconds}};
    say_why(row, ending, log);
    if (ending.started) add_figures(text_of(log), row);
    rows.push_back(row);
  }
  return rows;
}

Json run_sanitizer(const Place& place, const std::string& test_program, double budget) {
  Json row{{"program", test_program}, {"result", "not run"}};
  const std::string sanitizer = find_sanitizer();
  if (sanitizer.empty()) {
    row["why"] = "compute-sanitizer is not installed here";
    return row;
  }
  const fs::path log = place.logs / "compute-sanitizer.log";
  const Ending ending = run_one(
      {{sanitizer, "--tool", "memcheck", "--error-exitcode", "9", (place.folder / "tests" / test_program).string()},
       {},
       log,
       budget});
  row["result"] = result_of(ending);
  row["seconds"] = ending.seconds;
  say_why(row, ending, log);
  if (ending.started) row["summary"] = last_line(text_of(log));
  return row;
}

}  // namespace gpu_check
