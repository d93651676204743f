// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/decompose_batch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "catalog/input_error.h"
#include "workflows/error_json.h"
#include "workflows/stage_tool.h"

namespace workflows {
namespace {

using Json = nlohmann::ordered_json;
using catalog::LevelOfDetail;

constexpr int kJsonFormat = 1;  // raised when a key changes its meaning

std::string mesh_hash(const catalog::TriangleMesh& mesh) {
  std::string bytes(reinterpret_cast<const char*>(mesh.vertices.data()), mesh.vertices.size() * sizeof(catalog::Point));
  bytes.append(reinterpret_cast<const char*>(mesh.faces.data()), mesh.faces.size() * sizeof(catalog::Triangle));
  return catalog::sha256(bytes.data(), bytes.size());
}

/// Whether a stored level was made by this version, with these options, from this mesh.
bool is_current(const catalog::Provenance& stored, const std::string& hash,
                const decomposition::DecompositionOptions& options) {
  if (stored.tool_version != tool_version() || stored.source_sha256 != hash) return false;
  const Json kept = Json::parse(stored.options, nullptr, false);
  return kept.is_object() && kept.contains("options") &&
         kept["options"] == Json::parse(decomposition::options_json(options));
}

/// The level as stored if it need not be made again. One that came from an older schema lacks errors, so it is.
std::optional<LevelOfDetail> kept_level(const catalog::ShapeCatalog& shapes, catalog::ShapeId id,
                                        const std::string& hash, decomposition::DecompositionOptions options,
                                        int parts) {
  options.parts = parts;
  const catalog::LevelKey key{parts, options.vertex_cap, options.face_cap, options.mode};
  const catalog::ShapeSummary summary = shapes.summary(id);
  const bool is_there = std::any_of(summary.levels.begin(), summary.levels.end(), [&](const auto& level) {
    return level.key == key && !std::isnan(level.error.convexity_error);
  });
  if (!is_there) return std::nullopt;
  LevelOfDetail level = shapes.level(id, key);
  if (!is_current(level.provenance, hash, options)) return std::nullopt;
  return level;
}

/// Kept and new levels of one shape and one vertex cap, in the order asked for.
std::vector<DecomposedLevel> ladder_of(catalog::ShapeCatalog& shapes, catalog::ShapeId id,
                                       const catalog::ShapeRecord& shape, const std::vector<int>& part_counts,
                                       const decomposition::DecompositionOptions& quality) {
  const std::string hash = mesh_hash(shape.mesh);
  std::vector<DecomposedLevel> levels;
  std::vector<int> missing;
  for (const int parts : part_counts) {
    DecomposedLevel level{shape.name, {}, false, 0};
    if (auto kept = kept_level(shapes, id, hash, quality, parts))
      level.level = std::move(*kept);
    else {
      level.is_new = true;
      missing.push_back(parts);
    }
    levels.push_back(std::move(level));
  }
  if (missing.empty()) return levels;
  const auto start = std::chrono::steady_clock::now();
  std::vector<LevelOfDetail> made = decomposition::decompose_ladder(shape.mesh, missing, quality);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (LevelOfDetail& level : made) {
    level.provenance.source_file = shape.name;
    level.provenance.source_sha256 = hash;
    level.provenance.tool_version = tool_version();
  }
  shapes.store_levels(id, made);
  auto next = made.begin();
  for (DecomposedLevel& level : levels)
    if (level.is_new) {
      level.level = std::move(*next++);
      level.seconds = seconds;
    }
  return levels;
}

/// Kept and new levels of one shape, cap by cap.
std::vector<DecomposedLevel> levels_of(catalog::ShapeCatalog& shapes, catalog::ShapeId id,
                                       const DecomposeBatchOptions& options) {
  const catalog::ShapeRecord shape = shapes.shape(id);
  std::vector<DecomposedLevel> levels;
  for (const int cap : options.vertex_caps) {
    decomposition::DecompositionOptions quality = options.quality;
    quality.vertex_cap = cap;
    std::vector<DecomposedLevel> ladder = ladder_of(shapes, id, shape, options.part_counts, quality);
    std::move(ladder.begin(), ladder.end(), std::back_inserter(levels));
  }
  return levels;
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}

}  // namespace

DecomposeBatchResult decompose_shapes(catalog::ShapeCatalog& shapes, const DecomposeBatchOptions& options,
                                      const std::function<void(const std::string& name, std::size_t of)>& about_to) {
  const std::vector<catalog::ShapeId> ids = shapes.select(options.select);
  if (ids.empty())
    throw catalog::InputError(options.catalog +
                              (options.select.empty()
                                   ? ": has no shapes; fill it with talus digitize ... --into"
                                   : ": --select \"" + options.select + "\" selects no shape; see talus catalog list"));
  DecomposeBatchResult result;
  for (const catalog::ShapeId id : ids) {
    const std::string name = shapes.summary(id).name;
    about_to(name, ids.size());
    try {
      std::vector<DecomposedLevel> levels = levels_of(shapes, id, options);
      std::move(levels.begin(), levels.end(), std::back_inserter(result.levels));
    } catch (const catalog::InputError& error) {
      result.failures.push_back({name, error.what()});
    }
  }
  return result;
}

std::string batch_text(const DecomposeBatchResult& result) {
  std::size_t width = 5;
  for (const DecomposedLevel& row : result.levels) width = std::max(width, row.shape.size());
  std::string text =
      padded("shape", width) +
      "  asked    cap  parts  vertices  faces  difference_%  +-     missing_%  volume_%  surface_mean_%  surface_95_%"
      "  surface_max_%  seconds\n";
  for (const DecomposedLevel& row : result.levels) {
    const decomposition::LevelFigures figures = decomposition::figures(row.level.parts);
    const catalog::DecompositionError& error = row.level.error;
    char line[256];
    std::snprintf(line, sizeof line,
                  "  %5d  %5d  %5zu  %8d  %5d  %12.3f  %5.3f  %9.3f  %8.4f  %14.3f  %12.3f  %13.3f  ",
                  row.level.key.parts_asked, row.level.key.vertex_cap, row.level.parts.size(), figures.vertices,
                  figures.faces, 100 * error.symmetric_difference, 100 * error.method_error, 100 * error.missing_volume,
                  100 * error.volume_error, 100 * error.surface.mean, 100 * error.surface.percentile_95,
                  100 * error.surface.largest);
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%7.2f", row.seconds);
    text += padded(row.shape, width) + line + (row.is_new ? seconds : "   kept") + "\n";
  }
  return text;
}

std::string batch_json(const DecomposeBatchResult& result) {
  Json levels = Json::array(), failures = Json::array();
  for (const DecomposedLevel& row : result.levels) {
    const decomposition::LevelFigures figures = decomposition::figures(row.level.parts);
    Json level{{"shape", row.shape},
               {"mode", mode_name(row.level.key.mode)},
               {"parts_asked", row.level.key.parts_asked},
               {"parts", row.level.parts.size()},
               {"vertex_cap", row.level.key.vertex_cap},
               {"face_cap", row.level.key.face_cap},
               {"vertices", figures.vertices},
               {"faces", figures.faces}};
    level.update(error_json(row.level.error));
    level["new"] = row.is_new;
    level["seconds"] = row.seconds;
    levels.push_back(std::move(level));
  }
  for (const auto& failure : result.failures)
    failures.push_back({{"shape", failure.shape}, {"reason", failure.reason}});
  return Json{{"format", kJsonFormat}, {"levels", levels}, {"failures", failures}}.dump(2) + "\n";
}

}  // namespace workflows
