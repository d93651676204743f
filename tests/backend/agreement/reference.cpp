// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/agreement/reference.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catalog/input_error.h"

namespace agreement {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path folder_of(const fs::path& folder, const Case& agreement_case) {
  std::string name = agreement_case.name;
  std::erase(name, ',');
  std::replace(name.begin(), name.end(), ' ', '_');
  return folder / name;
}

std::vector<Bulk> read_bulks(const fs::path& file) {
  std::vector<Bulk> bulks;
  try {
    std::ifstream text(file);
    for (const Json& bulk : Json::parse(text))
      bulks.push_back({bulk.at("kinetic energy [J]"), bulk.at("mean height [m]"), bulk.at("coordination")});
  } catch (const Json::exception& error) {
    throw catalog::InputError(file.string() + ": " + error.what() + "; write the reference anew");
  }
  if (bulks.size() != std::size(kSeeds))
    throw catalog::InputError(file.string() + ": has " + std::to_string(bulks.size()) + " seeds, expected " +
                              std::to_string(std::size(kSeeds)) + "; write the reference anew");
  return bulks;
}

}  // namespace

Outcome outcome_from(const Case& agreement_case, const dem_gpu::Snapshot& start) {
  Outcome outcome{start, after_steps(agreement_case, start, 1), after_steps(agreement_case, start, kManySteps), {}};
  for (const int seed : kSeeds) outcome.bulks.push_back(bulk(agreement_case, start, static_cast<std::uint64_t>(seed)));
  return outcome;
}

void write_outcome(const fs::path& folder, const Case& agreement_case, const Outcome& outcome) {
  const fs::path own = folder_of(folder, agreement_case);
  fs::create_directories(own);
  dem_gpu::write_snapshot(own / "start.h5", outcome.start);
  dem_gpu::write_snapshot(own / "after_one.h5", outcome.after_one);
  dem_gpu::write_snapshot(own / "after_many.h5", outcome.after_many);
  Json bulks = Json::array();
  for (const Bulk& bulk : outcome.bulks)
    bulks.push_back({{"kinetic energy [J]", bulk.kinetic_energy},
                     {"mean height [m]", bulk.mean_height},
                     {"coordination", bulk.coordination}});
  std::ofstream text(own / "bulk.json");
  text << bulks.dump(2) << "\n";
  if (!text.flush()) throw catalog::InputError((own / "bulk.json").string() + ": cannot be written");
}

Outcome read_outcome(const fs::path& folder, const Case& agreement_case) {
  const fs::path own = folder_of(folder, agreement_case);
  return {dem_gpu::read_snapshot(own / "start.h5"), dem_gpu::read_snapshot(own / "after_one.h5"),
          dem_gpu::read_snapshot(own / "after_many.h5"), read_bulks(own / "bulk.json")};
}

}  // namespace agreement
