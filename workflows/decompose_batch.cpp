// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/decompose_batch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "catalog/input_error.h"
#include "workflows/batch_refusal.h"
#include "workflows/error_json.h"
#include "workflows/in_order.h"
#include "workflows/stage_tool.h"

namespace workflows {
namespace {

using Json = nlohmann::ordered_json;
using catalog::LevelOfDetail;

constexpr int kJsonFormat = 1;              // raised when a key changes its meaning
constexpr std::size_t kLargeMesh = 500000;  // faces; the search takes about 0.25 KB for each beside some 60 MB

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

/// What a shape has and lacks.
struct ShapeWork {
  catalog::ShapeId id = 0;
  std::string name, hash;
  std::size_t face_count = 0;
  std::vector<DecomposedLevel> levels;                 // cap by cap, in the order asked for; new ones are still empty
  std::vector<DecomposeBatchResult::Failure> refused;  // of the new ones

  bool is_refused(const DecomposedLevel& level) const {
    return std::any_of(refused.begin(), refused.end(),
                       [&](const auto& failure) { return *failure.level == level.level.key; });
  }

  bool lacks_levels() const {
    return std::any_of(levels.begin(), levels.end(), [](const DecomposedLevel& level) { return level.is_new; });
  }
};

decomposition::DecompositionOptions with_cap(const DecomposeBatchOptions& options, int vertex_cap) {
  decomposition::DecompositionOptions quality = options.quality;
  quality.vertex_cap = vertex_cap;
  quality.time_budget /= static_cast<double>(options.vertex_caps.size());
  return quality;
}

ShapeWork work_of(const catalog::ShapeCatalog& shapes, catalog::ShapeId id, const DecomposeBatchOptions& options) {
  const catalog::ShapeRecord shape = shapes.shape(id);
  ShapeWork work{id, shape.name, mesh_hash(shape.mesh), shape.mesh.face_count(), {}, {}};
  for (const int cap : options.vertex_caps)
    for (const int parts : options.part_counts) {
      DecomposedLevel level{shape.name, {}, true, 0};
      level.level.key = {parts, cap, options.quality.face_cap, options.quality.mode};
      if (auto kept = kept_level(shapes, id, work.hash, with_cap(options, cap), parts)) {
        level.level = std::move(*kept);
        level.is_new = false;
      }
      work.levels.push_back(std::move(level));
    }
  return work;
}

/// Fills in the levels that the shape lacks, a ladder for each cap, but for those that are refused.
void make_levels(const catalog::TriangleMesh& mesh, const DecomposeBatchOptions& options, int threads,
                 ShapeWork& work) {
  for (const int cap : options.vertex_caps) {
    std::vector<DecomposedLevel*> missing;
    std::vector<int> part_counts;
    for (DecomposedLevel& level : work.levels)
      if (level.is_new && level.level.key.vertex_cap == cap) {
        missing.push_back(&level);
        part_counts.push_back(level.level.key.parts_asked);
      }
    if (missing.empty()) continue;
    decomposition::DecompositionOptions quality = with_cap(options, cap);
    quality.threads = threads;
    const auto start = std::chrono::steady_clock::now();
    std::vector<decomposition::LevelOutcome> made = decomposition::decompose_levels(mesh, part_counts, quality);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (std::size_t k = 0; k < made.size(); ++k) {
      if (!made[k].refusal.empty()) {
        work.refused.push_back({work.name, made[k].refusal, missing[k]->level.key});
        continue;
      }
      LevelOfDetail& level = made[k].level;
      level.provenance.source_file = work.name;
      level.provenance.source_sha256 = work.hash;
      level.provenance.tool_version = tool_version();
      missing[k]->level = std::move(level);
      missing[k]->seconds = seconds;
    }
  }
}

std::vector<catalog::ShapeId> selected(const catalog::ShapeCatalog& shapes, const DecomposeBatchOptions& options) {
  std::vector<catalog::ShapeId> ids;
  for (const std::string& name : options.names)
    if (const auto id = shapes.find(name)) ids.push_back(*id);
  if (options.names.empty()) ids = shapes.select(options.select);
  if (ids.empty())
    throw catalog::InputError(options.catalog +
                              (options.select.empty()
                                   ? ": has no shapes; fill it with talus digitize ... --into"
                                   : ": --select \"" + options.select + "\" selects no shape; see talus catalog list"));
  return ids;
}

/// How many shapes are in work at a time, and with how many threads each.
struct Sharing {
  int shapes, threads_each;
};

Sharing sharing(const std::vector<ShapeWork*>& lacking, const DecomposeBatchOptions& options) {
  const int threads = threads_to_use(options.quality.threads);
  const bool is_large =
      std::any_of(lacking.begin(), lacking.end(), [](const ShapeWork* work) { return work->face_count > kLargeMesh; });
  // A time budget counts the CPU time of all threads together.
  if (is_large || options.quality.time_budget > 0) return {1, threads};
  const int at_once = std::clamp(static_cast<int>(lacking.size()), 1, threads);
  return {at_once, threads / at_once};
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}

template <class... Values>
std::string printed(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

}  // namespace

DecomposeBatchResult decompose_shapes(catalog::ShapeCatalog& shapes, const DecomposeBatchOptions& options,
                                      const std::function<void(const std::string& name, std::size_t of)>& about_to) {
  std::vector<ShapeWork> all;
  for (const catalog::ShapeId id : selected(shapes, options)) all.push_back(work_of(shapes, id, options));
  std::vector<ShapeWork*> lacking;
  for (ShapeWork& work : all)
    if (work.lacks_levels()) lacking.push_back(&work);

  const Sharing share = sharing(lacking, options);
  DecomposeBatchResult result;
  std::mutex catalog_use;
  OrderedWork<std::string> batch;
  batch.count = static_cast<int>(lacking.size());
  batch.threads = share.shapes;
  batch.begin = [&](int k) { about_to(lacking[static_cast<std::size_t>(k)]->name, lacking.size()); };
  batch.make = [&](int k) {
    ShapeWork& work = *lacking[static_cast<std::size_t>(k)];
    std::unique_lock lock(catalog_use);
    const catalog::TriangleMesh mesh = shapes.shape(work.id).mesh;
    lock.unlock();
    return refusal_of("mesh", [&] { make_levels(mesh, options, share.threads_each, work); });
  };
  batch.take = [&](int k, std::string&& reason) {
    ShapeWork& work = *lacking[static_cast<std::size_t>(k)];
    if (!reason.empty()) {
      result.failures.push_back({work.name, reason, std::nullopt});
      std::erase_if(work.levels, [](const DecomposedLevel& level) { return level.is_new; });
      return;
    }
    std::erase_if(work.levels, [&](const DecomposedLevel& level) { return work.is_refused(level); });
    std::move(work.refused.begin(), work.refused.end(), std::back_inserter(result.failures));
    std::vector<LevelOfDetail> made;
    for (const DecomposedLevel& level : work.levels)
      if (level.is_new) made.push_back(level.level);
    const std::lock_guard lock(catalog_use);
    shapes.store_levels(work.id, made);
  };
  run_in_order(batch);
  for (ShapeWork& work : all) std::move(work.levels.begin(), work.levels.end(), std::back_inserter(result.levels));
  return result;
}

std::string batch_text(const DecomposeBatchResult& result) {
  const auto any = [&](auto tells) { return std::any_of(result.levels.begin(), result.levels.end(), tells); };
  const bool has_mode = any([](const auto& row) { return row.level.key.mode != catalog::FitMode::volume_true; });
  const bool has_face_cap = any([](const auto& row) { return row.level.key.face_cap > 0; });
  std::size_t width = 5;
  for (const DecomposedLevel& row : result.levels) width = std::max(width, row.shape.size());
  std::string text = padded("shape", width) + (has_mode ? "  mode       " : "") + "  asked    cap" +
                     (has_face_cap ? "  faces<=" : "") +
                     "  parts  vertices  faces  difference_%  +-     missing_%  volume_%  surface_mean_%  surface_95_%"
                     "  surface_max_%  seconds\n";
  for (const DecomposedLevel& row : result.levels) {
    const catalog::LevelKey& key = row.level.key;
    const decomposition::LevelFigures figures = decomposition::figures(row.level.parts);
    const catalog::DecompositionError& error = row.level.error;
    text += padded(row.shape, width);
    if (has_mode) text += "  " + padded(mode_name(key.mode), 11);
    text += printed("  %5d  %5d", key.parts_asked, key.vertex_cap);
    if (has_face_cap) text += key.face_cap > 0 ? printed("  %7d", key.face_cap) : "        -";
    text += printed("  %5zu  %8d  %5d  %12.3f  %5.3f  %9.3f  %8.4f  %14.3f  %12.3f  %13.3f  ", row.level.parts.size(),
                    figures.vertices, figures.faces, 100 * error.symmetric_difference, 100 * error.method_error,
                    100 * error.missing_volume, 100 * error.volume_error, 100 * error.surface.mean,
                    100 * error.surface.percentile_95, 100 * error.surface.largest);
    text += (row.is_new ? printed("%7.2f", row.seconds) : "   kept") + "\n";
  }
  return text;
}

std::string failure_text(const DecomposeBatchResult::Failure& failure) {
  if (!failure.level) return failure.shape + ": not decomposed: " + failure.reason;
  const int parts = failure.level->parts_asked;
  return failure.shape + ": " + std::to_string(parts) + (parts == 1 ? " part of " : " parts of ") +
         std::to_string(failure.level->vertex_cap) + " vertices: not made: " + failure.reason;
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
  for (const auto& failure : result.failures) {
    failures.push_back({{"shape", failure.shape}, {"reason", failure.reason}});
    if (!failure.level) continue;
    failures.back()["parts_asked"] = failure.level->parts_asked;
    failures.back()["vertex_cap"] = failure.level->vertex_cap;
  }
  return Json{{"format", kJsonFormat}, {"levels", levels}, {"failures", failures}}.dump(2) + "\n";
}

}  // namespace workflows
