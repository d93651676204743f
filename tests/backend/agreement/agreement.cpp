// SPDX-License-Identifier: Apache-2.0
// Two back ends on the same scenes: one writes, the other compares.
//   agreement --write FOLDER                  reference files of this build's back end
//   agreement --compare FOLDER [--json FILE]  the same on this build's, held against them; exit status 4 if they differ
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catalog/input_error.h"
#include "tests/backend/agreement/comparison.h"

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFailed = 1, kUsage = 2, kBadInput = 3, kDiffers = 4;

int write(const std::string& folder) {
  for (const agreement::Case& one : agreement::cases()) {
    agreement::write_outcome(folder, one, agreement::outcome_from(one, agreement::settled(one)));
    std::printf("%s written\n", one.name.c_str());
  }
  return 0;
}

Json row_of(const std::string& name, const agreement::Agreement& row) {
  return {{"case", name},
          {"what", row.what},
          {"difference", row.difference},
          {"tolerance", row.tolerance},
          {"agrees", row.holds()}};
}

int compare(const std::string& folder, const std::string& json_file) {
  Json rows = Json::array();
  int differing = 0;
  for (const agreement::Case& one : agreement::cases()) {
    const agreement::Outcome reference = agreement::read_outcome(folder, one);
    for (const agreement::Agreement& row : compare(reference, agreement::outcome_from(one, reference.start))) {
      std::printf("%-20s %-26s %10.3g (at most %.3g)%s\n", one.name.c_str(), row.what.c_str(), row.difference,
                  row.tolerance, row.holds() ? "" : "  DIFFERS");
      rows.push_back(row_of(one.name, row));
      differing += !row.holds();
    }
  }
  if (!json_file.empty()) {
    std::ofstream text(json_file);
    text << rows.dump(2) << "\n";
    if (!text.flush()) throw catalog::InputError(json_file + ": cannot be written");
  }
  return differing > 0 ? kDiffers : 0;
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 2 && words[0] == "--write") return write(words[1]);
  if (words.size() == 2 && words[0] == "--compare") return compare(words[1], "");
  if (words.size() == 4 && words[0] == "--compare" && words[2] == "--json") return compare(words[1], words[3]);
  std::fprintf(stderr, "usage: agreement --write FOLDER | --compare FOLDER [--json FILE]\n");
  return kUsage;
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  try {
    return run({argv + 1, argv + argc});
  } catch (const catalog::InputError& error) {
    std::fprintf(stderr, "agreement: %s\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "agreement: %s\n", error.what());
    return kFailed;
  }
}
