// SPDX-License-Identifier: Apache-2.0
// Everything that is worth knowing of a GPU, from the folder that make gpu-check builds: engine tests, agreement with
// the CPU, benches, into one JSON file.
//   gpu_check FOLDER OUT.json [--without-device]
// Exit status 4 if a test or the agreement did not pass, 5 without a device; --without-device goes on there.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catalog/input_error.h"
#include "tests/backend/gpu_check/device.h"
#include "tests/backend/gpu_check/stages.h"

namespace {

namespace fs = std::filesystem;
using gpu_check::Json;

constexpr int kFailed = 1, kUsage = 2, kBadInput = 3, kNotPassed = 4, kNoDevice = 5;

// All in eight minutes. What a stage leaves over, later ones may use [s since the start].
constexpr double kTestsUntil = 210, kAgreementUntil = 260, kBenchesUntil = 440, kSanitizerUntil = 470;
constexpr const char* kSanitized = "dem_contact_test";

Json row_of(const gpu_check::Device& device) {
  return {{"name", device.name},
          {"compute capability", device.capability},
          {"multiprocessors", device.multiprocessors},
          {"memory [bytes]", device.memory},
          {"driver", device.driver},
          {"newest CUDA of the driver", device.newest_cuda},
          {"CUDA runtime", device.runtime}};
}

/// Adds a row that did not pass to the list that nobody can overlook.
void list_if_wanting(const std::string& what, const Json& row, Json& list) {
  if (row.at("result") == "passed") return;
  std::string line = what + ": " + row.at("result").get<std::string>();
  if (row.contains("why")) line += ", " + row.at("why").get<std::string>();
  for (const Json& name : row.value("failures", Json::array())) line += ", " + name.get<std::string>();
  list.push_back(line);
}

/// All stages one after the other.
void run_stages(const gpu_check::Place& place, bool has_device, Json& report) {
  const auto begin = std::chrono::steady_clock::now();
  const auto left_until = [&](double time) {
    return time - std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  Json wanting = Json::array(), not_run = Json::array();
  const auto tests = gpu_check::read_tests(place.folder / "tests.txt");
  const auto benches = gpu_check::read_benches(place.folder / "benches.txt");

  report["tests"] = gpu_check::run_tests(place, tests, left_until(kTestsUntil));
  for (const Json& row : report["tests"]) {
    list_if_wanting(row.at("name"), row, wanting);
    for (const Json& name : row.at("skipped")) not_run.push_back(name.get<std::string>() + ": skipped by itself");
  }
  report["agreement with the CPU"] = gpu_check::run_agreement(place, left_until(kAgreementUntil));
  list_if_wanting("agreement with the CPU", report["agreement with the CPU"], wanting);
  report["benches"] = gpu_check::run_benches(place, benches, left_until(kBenchesUntil));
  for (const Json& row : report["benches"]) list_if_wanting("bench " + row.at("name").get<std::string>(), row, not_run);
  report["compute-sanitizer"] = has_device ? gpu_check::run_sanitizer(place, kSanitized, left_until(kSanitizerUntil))
                                           : Json{{"result", "not run"}, {"why", "no device"}};
  const Json& sanitized = report["compute-sanitizer"];
  list_if_wanting("compute-sanitizer", sanitized, sanitized.at("result") == "failed" ? wanting : not_run);
  report["did not pass"] = wanting;
  report["not run or cut short"] = not_run;
  report["seconds"] = -left_until(0);
}

int check(const fs::path& folder, const fs::path& out, bool without_device) {
  Json report{{"talus", TALUS_VERSION}, {"backend", TALUS_BACKEND_NAME}, {"device", nullptr}};
  std::string why;
  const auto device = gpu_check::find_device(why);
  if (device)
    report["device"] = row_of(*device);
  else
    report["no device"] = why;
  if (device || without_device) {
    const gpu_check::Place place{fs::absolute(folder), fs::absolute(out.string() + ".logs")};
    fs::create_directories(place.logs);
    run_stages(place, device.has_value(), report);
  }
  const bool has_passed = report.contains("tests") && report["did not pass"].empty();
  report["passed"] = has_passed;
  std::ofstream text(out);
  text << report.dump(2) << "\n";
  if (!text.flush()) throw catalog::InputError(out.string() + ": cannot be written");
  for (const char* list : {"did not pass", "not run or cut short"})
    for (const Json& line : report.value(list, Json::array()))
      std::printf("%s: %s\n", list, line.get<std::string>().c_str());
  std::printf("%s: %s\n", out.c_str(), has_passed ? "all tests passed" : "not everything passed");
  if (!device) std::fprintf(stderr, "gpu_check: no device (%s)\n", why.c_str());
  return !device && !without_device ? kNoDevice : has_passed ? 0 : kNotPassed;
}

}  // namespace

int main(int argc, char** argv) {
  const bool without_device = argc == 4 && std::string(argv[3]) == "--without-device";
  if (argc != 3 && !without_device) {
    std::fprintf(stderr, "usage: gpu_check FOLDER OUT.json [--without-device]\n");
    return kUsage;
  }
  try {
    return check(argv[1], argv[2], without_device);
  } catch (const catalog::InputError& error) {
    std::fprintf(stderr, "gpu_check: %s\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "gpu_check: %s\n", error.what());
    return kFailed;
  }
}
