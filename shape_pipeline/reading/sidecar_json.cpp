// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/reading/sidecar_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catalog/nearest_word.h"
#include "shape_pipeline/reading/scan_bytes.h"

namespace shape_pipeline {

nlohmann::json read_sidecar_json(const std::filesystem::path& path, const std::vector<std::string>& known,
                                 const std::string& what, const std::string& example) {
  nlohmann::json values;
  try {
    values = nlohmann::json::parse(read_scan_bytes(path));
  } catch (const nlohmann::json::parse_error& error) {
    refuse_file(path, "byte " + std::to_string(error.byte), "is no JSON", example);
  } catch (const nlohmann::json::out_of_range&) {
    refuse_file(path, "", "holds a number that is too large", example);
  }
  if (!values.is_object()) refuse_file(path, "", "is no JSON object", example);
  for (const auto& [key, value] : values.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      refuse_file(path, key, "is no key of " + what, catalog::word_hint(key, known));
  return values;
}

}  // namespace shape_pipeline
