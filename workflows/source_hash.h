// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"

namespace workflows {

/// SHA-256 of a source: of one file its own; of several that of the list of theirs.
inline std::string hash_of_files(const std::vector<std::filesystem::path>& files) {
  if (files.size() == 1) return catalog::sha256_of_file(files[0]);
  std::string list;
  for (const std::filesystem::path& file : files) list += catalog::sha256_of_file(file) + "\n";
  return catalog::sha256(list.data(), list.size());
}

/// Whether two things were made from the same bytes with the same options by the same version.
inline bool is_same_making(const catalog::Provenance& a, const catalog::Provenance& b) {
  return a.source_sha256 == b.source_sha256 && a.options == b.options && a.tool_version == b.tool_version;
}

}  // namespace workflows
