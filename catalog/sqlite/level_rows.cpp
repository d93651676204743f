// SPDX-License-Identifier: Apache-2.0
#include "catalog/sqlite/level_rows.h"

#include "catalog/sqlite/row_parts.h"

namespace catalog::sqlite {
namespace {

/// Column names in the order of error_figures().
constexpr const char* kErrorColumns =
    "symmetric_difference, method_error, missing_volume, volume_error, overlap, surface_from_mesh_mean, "
    "surface_from_mesh_95, surface_from_mesh_max, surface_from_union_mean, surface_from_union_95, "
    "surface_from_union_max, surface_mean, surface_95, surface_max, centre_error, inertia_error, convexity_error";

/// The figures of an error, `Error` const or not.
template <class Error>
auto error_figures(Error& error) {
  return std::array{&error.symmetric_difference,
                    &error.method_error,
                    &error.missing_volume,
                    &error.volume_error,
                    &error.overlap,
                    &error.surface_from_mesh.mean,
                    &error.surface_from_mesh.percentile_95,
                    &error.surface_from_mesh.largest,
                    &error.surface_from_union.mean,
                    &error.surface_from_union.percentile_95,
                    &error.surface_from_union.largest,
                    &error.surface.mean,
                    &error.surface.percentile_95,
                    &error.surface.largest,
                    &error.centre_error,
                    &error.inertia_error,
                    &error.convexity_error};
}

DecompositionError error_at(const Statement& row, int column) {
  DecompositionError error;
  for (double* figure : error_figures(error)) *figure = row.real(column++);
  return error;
}

LevelKey key_at(const Statement& row, int column) {
  const std::optional<FitMode> mode = mode_named(row.text(column + 3));
  if (!mode) throw DamagedBlob("its mode '" + row.text(column + 3) + "' is none of the known ones");
  return {static_cast<int>(row.integer(column)), static_cast<int>(row.integer(column + 1)),
          static_cast<int>(row.integer(column + 2)), *mode};
}

constexpr const char* kKeyIs = "shape_id = ? AND parts_asked = ? AND vertex_cap = ? AND face_cap = ? AND mode = ?";

void bind_key(Statement& row, ShapeId id, const LevelKey& key) {
  row.bind(id, key.parts_asked, key.vertex_cap, key.face_cap, mode_name(key.mode));
}

}  // namespace

void write_level(const Database& database, ShapeId id, const LevelOfDetail& level) {
  Statement old(database, std::string("DELETE FROM levels WHERE ") + kKeyIs);
  bind_key(old, id, level.key);
  old.run();
  const ShapeId level_id = single_integer(database, "SELECT ifnull(max(id), 0) + 1 FROM levels");
  Statement row(database,
                std::string("INSERT INTO levels (id, shape_id, parts_asked, vertex_cap, face_cap, mode, part_count, "
                            "volume, centroid_x, centroid_y, centroid_z, principal_inertia_1, principal_inertia_2, "
                            "principal_inertia_3, mass_properties, ") +
                    kErrorColumns +
                    ", source_file, source_sha256, tool_version, options) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
                    "?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  row.bind(level_id, id, level.key.parts_asked, level.key.vertex_cap, level.key.face_cap, mode_name(level.key.mode),
           level.parts.size());
  add_mass_properties(row, level.mass_properties);
  for (const double* figure : error_figures(level.error)) row.add(*figure);
  add_provenance(row, level.provenance);
  row.run();

  Statement part_row(database, "INSERT INTO parts VALUES (?, ?, ?, ?, ?, ?)");
  int position = 0;
  for (const ConvexPart& part : level.parts) {
    const Bytes encoding = encode_part(part);
    part_row
        .bind(level_id, position++, part.vertex_count(), part.face_count(), compressed(encoding), sha256_of(encoding))
        .run();
  }
}

std::vector<ShapeSummary::Level> read_levels(const Database& database, ShapeId id) {
  Statement row(database, std::string("SELECT parts_asked, vertex_cap, face_cap, mode, part_count, "
                                      "(SELECT total(vertex_count) FROM parts WHERE level_id = levels.id), "
                                      "(SELECT total(face_count) FROM parts WHERE level_id = levels.id), ") +
                              kErrorColumns +
                              " FROM levels WHERE shape_id = ? "
                              "ORDER BY mode != 'volume-true', mode, parts_asked, vertex_cap, face_cap");
  std::vector<ShapeSummary::Level> levels;
  decode(database, "a level of shape " + std::to_string(id), [&] {
    for (row.bind(id); row.step();)
      levels.push_back({key_at(row, 0), static_cast<int>(row.integer(4)), static_cast<int>(row.integer(5)),
                        static_cast<int>(row.integer(6)), error_at(row, 7)});
  });
  return levels;
}

LevelOfDetail read_level(const Database& database, ShapeId id, const std::string& name, const LevelKey& key) {
  Statement row(database,
                std::string("SELECT id, mass_properties, source_file, source_sha256, tool_version, options, ") +
                    kErrorColumns + " FROM levels WHERE " + kKeyIs);
  bind_key(row, id, key);
  if (!row.step()) {
    std::string kept;
    for (const auto& level : read_levels(database, id)) kept += (kept.empty() ? "" : "; ") + described(level.key);
    throw InputError(database.path().string() + ": " + name + " has no level of " + described(key) +
                     "; kept: " + (kept.empty() ? "none, run talus decompose first" : kept));
  }
  LevelOfDetail level;
  level.key = key;
  level.provenance = provenance_at(row, 2);
  level.error = error_at(row, 6);
  decode(database, "the level of " + name + " with " + described(key), [&] {
    level.mass_properties = decode_mass_properties(row.blob(1));
    Statement part(database, "SELECT encoding, sha256 FROM parts WHERE level_id = ? ORDER BY position");
    for (part.bind(row.integer(0)); part.step();) {
      const Bytes encoding = decompressed(part.blob(0));
      expect_hash(part.text(1), sha256_of(encoding));
      level.parts.push_back(decode_part(encoding));
    }
  });
  return level;
}

}  // namespace catalog::sqlite
