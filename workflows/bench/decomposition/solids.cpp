// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/bench/decomposition/solids.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "catalog/input_error.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/mesh_repair.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

struct NamedScan {
  const char* name;
  const char* file;
};
constexpr NamedScan kScans[] = {{"stone14", "epfl_stone14.stl"},
                                {"stone10", "epfl_stone10.stl"},
                                {"ashlar_1050", "ashlar_1050.obj"},
                                {"itokawa", "itokawa_radar_25143.tab"}};

/// Of 24 x 12 quads, each two triangles; radii 1 and 0.4, axis z.
catalog::TriangleMesh torus() {
  constexpr int kAround = 24, kAcross = 12;
  constexpr double kBig = 1, kSmall = 0.4;
  catalog::TriangleMesh mesh;
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < kAcross; ++j) {
      const double a = 2 * std::numbers::pi * i / kAround, b = 2 * std::numbers::pi * j / kAcross;
      const double r = kBig + kSmall * std::cos(b);
      mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), kSmall * std::sin(b)});
      const int next_i = (i + 1) % kAround * kAcross, next_j = (j + 1) % kAcross;
      mesh.faces.push_back({i * kAcross + j, next_i + j, next_i + next_j});
      mesh.faces.push_back({i * kAcross + j, next_i + next_j, i * kAcross + next_j});
    }
  return mesh;
}

catalog::TriangleMesh scan(const fs::path& file) {
  shape_pipeline::RepairOptions options;
  options.wrapping = shape_pipeline::Wrapping::never;
  shape_pipeline::RepairedMesh repaired = shape_pipeline::repair_mesh(shape_pipeline::read_mesh(file, 1), options);
  if (!repaired.refusal.empty()) throw catalog::InputError(file.string() + ": " + repaired.refusal);
  return std::move(repaired.mesh);
}

const NamedScan* scan_named(const std::string& name) {
  const auto found = std::find_if(std::begin(kScans), std::end(kScans), [&](const auto& s) { return s.name == name; });
  return found == std::end(kScans) ? nullptr : found;
}

}  // namespace

BenchSolids::BenchSolids(fs::path scans) : scans_(std::move(scans)) {
  if (!scans_.empty() && !fs::is_directory(scans_))
    throw catalog::InputError(scans_.string() + ": --scans expects a folder with scans such as " + kScans[0].file);
}

bool BenchSolids::has(const std::string& name) const {
  const NamedScan* scan = scan_named(name);
  return !scan || (!scans_.empty() && fs::is_regular_file(scans_ / scan->file));
}

std::vector<std::string> BenchSolids::missing() const {
  std::vector<std::string> names;
  for (const NamedScan& scan : kScans)
    if (!has(scan.name)) names.push_back(std::string(scan.name) + " (" + scan.file + ")");
  return names;
}

const catalog::TriangleMesh& BenchSolids::mesh(const std::string& name) {
  const auto found = meshes_.find(name);
  if (found != meshes_.end()) return found->second;
  const NamedScan* named = scan_named(name);
  return meshes_[name] = named ? scan(scans_ / named->file) : torus();
}

}  // namespace workflows
