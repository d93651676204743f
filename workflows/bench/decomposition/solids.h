// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace workflows {

/// The solids that the bench measures; scans are read when first asked for.
class BenchSolids {
 public:
  /// Throws catalog::InputError if `scans` is neither empty nor a folder.
  explicit BenchSolids(std::filesystem::path scans);

  /// Whether the solid needs no file, or its file is there.
  bool has(const std::string& name) const;

  /// "stone14 (epfl_stone14.stl)" of every solid that is not there.
  std::vector<std::string> missing() const;

  /// As the file has it, welded, every face kept. Throws catalog::InputError for a scan that is no right solid.
  const catalog::TriangleMesh& mesh(const std::string& name);

 private:
  std::filesystem::path scans_;
  std::map<std::string, catalog::TriangleMesh> meshes_;
};

}  // namespace workflows
