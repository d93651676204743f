// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/stack_sources.h"

#include <algorithm>
#include <cctype>

#include "shape_pipeline/reading/folder_files.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/volumes/stack_file.h"

namespace shape_pipeline {

std::string lower_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool has_stack_ending(const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  return ending == ".tif" || ending == ".tiff" || ending == ".nrrd" || ending == ".nhdr" || ending == ".raw";
}

std::vector<std::filesystem::path> stack_sources(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) {
    const std::string ending = lower_ending(path);
    if (ending == ".raw") return {path, std::filesystem::path(path).replace_extension(".json")};
    if (ending == ".nhdr") return {path, nrrd_values_file(path)};
    return {path};
  }
  const std::vector<std::vector<std::string>> kinds{{".tif", ".tiff"}, {".png"}, {".bmp"}, {".jpg", ".jpeg"}};
  std::vector<std::filesystem::path> slices;
  for (const std::vector<std::string>& endings : kinds) {
    std::vector<std::filesystem::path> found = files_in_natural_order(path, endings);
    if (found.empty()) continue;
    if (!slices.empty())
      refuse_file(path, "",
                  "holds images of two kinds, such as " + slices.front().filename().string() + " and " +
                      found.front().filename().string(),
                  "leave there the slices alone");
    slices = std::move(found);
  }
  if (slices.empty()) refuse_file(path, "", "no slices in this folder", "put one TIFF, PNG, BMP or JPEG a slice there");
  return slices;
}

}  // namespace shape_pipeline
