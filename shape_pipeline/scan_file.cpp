// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/scan_file.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "shape_pipeline/reading/ply_file.h"
#include "shape_pipeline/reading/scan_bytes.h"

namespace shape_pipeline {
namespace {

constexpr std::array<std::string_view, 5> kCloudEndings{".pcd", ".xyz", ".txt", ".asc", ".pwn"};
constexpr std::array<std::string_view, 4> kMeshEndings{".stl", ".obj", ".off", ".tab"};

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& endings, const std::string& ending) {
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// What cannot even be looked at, such as a link that leads nowhere, is no folder.
bool leads_to_folder(const std::filesystem::directory_entry& entry) {
  std::error_code error;
  return entry.is_directory(error);
}

}  // namespace

ScanKind scan_kind(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (contains(kCloudEndings, ending)) return ScanKind::point_cloud;
  if (contains(kMeshEndings, ending)) return ScanKind::mesh;
  if (ending != ".ply")
    refuse_file(path, "", "'" + ending + "' is no scan format read here",
                "save clouds as PLY, PCD or XYZ and meshes as STL, OBJ, PLY or OFF");
  return ply_face_count(path) > 0 ? ScanKind::mesh : ScanKind::point_cloud;
}

bool has_scan_ending(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".ply" || contains(kCloudEndings, ending) || contains(kMeshEndings, ending);
}

std::vector<std::filesystem::path> scan_files(const std::vector<std::filesystem::path>& inputs) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& input : inputs) {
    if (!std::filesystem::is_directory(input)) {
      files.push_back(input);
      continue;
    }
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(input))
      if (!leads_to_folder(entry) && has_scan_ending(entry.path()) && ending_of(entry.path()) != ".txt")
        found.push_back(entry.path());
    if (found.empty())
      refuse_file(input, "", "no scan files in this folder",
                  "put PLY, PCD, XYZ, STL, OBJ or OFF files there, or say --stack if it holds the slices of one");
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

}  // namespace shape_pipeline
