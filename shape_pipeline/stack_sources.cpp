// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/stack_sources.h"

#include <algorithm>
#include <cctype>

#include "shape_pipeline/reading/folder_files.h"
#include "shape_pipeline/reading/scan_bytes.h"

namespace shape_pipeline {

std::string lower_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool has_stack_ending(const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  return ending == ".tif" || ending == ".tiff" || ending == ".nrrd" || ending == ".raw";
}

std::vector<std::filesystem::path> stack_sources(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) {
    if (lower_ending(path) != ".raw") return {path};
    return {path, std::filesystem::path(path).replace_extension(".json")};
  }
  std::vector<std::filesystem::path> slices = files_in_natural_order(path, {".tif", ".tiff"});
  if (slices.empty()) refuse_file(path, "", "no TIFF slices in this folder", "put one TIFF a slice there");
  return slices;
}

}  // namespace shape_pipeline
