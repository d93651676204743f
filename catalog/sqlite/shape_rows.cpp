// SPDX-License-Identifier: Apache-2.0
#include "catalog/sqlite/shape_rows.h"

#include "catalog/input_error.h"
#include "catalog/sqlite/encoding.h"
#include "catalog/sqlite/statement.h"

namespace catalog::sqlite {
namespace {

void add_mass_properties(Statement& statement, const MassProperties& properties) {
  statement.add(properties.volume);
  for (const double coordinate : properties.centroid) statement.add(coordinate);
  for (const double moment : properties.principal_inertia) statement.add(moment);
  statement.add(encode_mass_properties(properties));
}

void add_provenance(Statement& statement, const Provenance& provenance) {
  statement.add(provenance.source_file);
  statement.add(provenance.source_sha256);
  statement.add(provenance.tool_version);
  statement.add(provenance.options);
}

Provenance provenance_at(const Statement& row, int column) {
  return {row.text(column), row.text(column + 1), row.text(column + 2), row.text(column + 3)};
}

/// Column names in the order of DecompositionError.
constexpr const char* kErrorColumns =
    "symmetric_difference, missing_volume, volume_error, surface_mean, surface_max, overlap, method_error";

DecompositionError error_at(const Statement& row, int column) {
  return {row.real(column),     row.real(column + 1), row.real(column + 2), row.real(column + 3),
          row.real(column + 4), row.real(column + 5), row.real(column + 6)};
}

/// Runs a decoder and names file and row where its bytes do not make sense.
template <class Decode>
auto decode(const Database& database, const std::string& what, Decode decoder) {
  try {
    return decoder();
  } catch (const DamagedBlob& damage) {
    throw InputError(database.path().string() + ": " + what + " is damaged (" + damage.what() +
                     "); expected a whole catalogue; restore it from a copy");
  }
}

void expect_hash(const std::string& stored, const std::string& found) {
  if (stored != found) throw DamagedBlob("its SHA-256 does not fit");
}

[[noreturn]] void no_such_shape(const Database& database, ShapeId id) {
  throw InputError(database.path().string() + ": has no shape with id " + std::to_string(id));
}

void write_mesh(const Database& database, ShapeId id, const TriangleMesh& mesh) {
  const Bytes vertices = encode_vertices(mesh.vertices), faces = encode_faces(mesh.faces);
  Statement(database, "INSERT INTO meshes VALUES (?, ?, ?, ?, ?, ?)")
      .bind(id, mesh.vertex_count(), mesh.face_count(), compressed(vertices), compressed(faces),
            sha256_of(vertices, faces))
      .run();
}

TriangleMesh read_mesh(const Database& database, ShapeId id, const std::string& name) {
  Statement row(database, "SELECT vertices, faces, sha256 FROM meshes WHERE shape_id = ?");
  return decode(database, "the mesh of " + name, [&] {
    if (!row.bind(id).step()) throw DamagedBlob("it is missing");
    const Bytes vertices = decompressed(row.blob(0)), faces = decompressed(row.blob(1));
    expect_hash(row.text(2), sha256_of(vertices, faces));
    return decode_mesh(vertices, faces);
  });
}

std::map<std::string, double> read_descriptors(const Database& database, ShapeId id) {
  std::map<std::string, double> descriptors;
  Statement row(database, "SELECT name, value FROM descriptors WHERE shape_id = ?");
  for (row.bind(id); row.step();) descriptors[row.text(0)] = row.real(1);
  return descriptors;
}

std::vector<Check> read_checks(const Database& database, ShapeId id) {
  std::vector<Check> checks;
  Statement row(database, "SELECT name, passed, figure, detail FROM checks WHERE shape_id = ? ORDER BY position");
  for (row.bind(id); row.step();) checks.push_back({row.text(0), row.integer(1) != 0, row.real(2), row.text(3)});
  return checks;
}

std::string quoted(const std::string& name, char quote) {
  std::string text(1, quote);
  for (const char letter : name) text += letter == quote ? std::string(2, quote) : std::string(1, letter);
  return text + quote;
}

}  // namespace

ShapeId write_shape(const Database& database, const ShapeRecord& shape) {
  Statement known(database, "SELECT id FROM shapes WHERE name = ?");
  ShapeId id = known.bind(shape.name).step() ? known.integer(0)
                                             : single_integer(database, "SELECT ifnull(max(id), 0) + 1 FROM shapes");
  Statement(database, "DELETE FROM shapes WHERE id = ?").bind(id).run();
  Statement(database, "DELETE FROM rejected WHERE name = ?").bind(shape.name).run();

  Statement row(database, "INSERT INTO shapes VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  row.bind(id, shape.name);
  add_mass_properties(row, shape.mass_properties);
  add_provenance(row, shape.provenance);
  row.run();
  write_mesh(database, id, shape.mesh);

  Statement descriptor(database, "INSERT INTO descriptors VALUES (?, ?, ?)");
  for (const auto& [name, value] : shape.descriptors) descriptor.bind(id, name, value).run();
  Statement check(database, "INSERT INTO checks VALUES (?, ?, ?, ?, ?, ?)");
  int position = 0;
  for (const Check& made : shape.checks)
    check.bind(id, position++, made.name, made.passed, made.figure, made.detail).run();
  return id;
}

void write_level(const Database& database, ShapeId id, const LevelOfDetail& level) {
  Statement(database, "DELETE FROM levels WHERE shape_id = ? AND parts_asked = ? AND vertex_cap = ?")
      .bind(id, level.parts_asked, level.vertex_cap)
      .run();
  const ShapeId level_id = single_integer(database, "SELECT ifnull(max(id), 0) + 1 FROM levels");
  Statement row(database,
                "INSERT INTO levels VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  row.bind(level_id, id, level.parts_asked, level.vertex_cap, level.parts.size());
  add_mass_properties(row, level.mass_properties);
  const DecompositionError& error = level.error;
  for (const double figure : {error.symmetric_difference, error.missing_volume, error.volume_error, error.surface_mean,
                              error.surface_max, error.overlap, error.method_error})
    row.add(figure);
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

ShapeRecord read_shape(const Database& database, ShapeId id) {
  Statement row(database,
                "SELECT name, mass_properties, source_file, source_sha256, tool_version, options FROM shapes "
                "WHERE id = ?");
  if (!row.bind(id).step()) no_such_shape(database, id);
  ShapeRecord shape;
  shape.name = row.text(0);
  shape.mass_properties =
      decode(database, "the row of " + shape.name, [&] { return decode_mass_properties(row.blob(1)); });
  shape.provenance = provenance_at(row, 2);
  shape.mesh = read_mesh(database, id, shape.name);
  shape.descriptors = read_descriptors(database, id);
  shape.checks = read_checks(database, id);
  return shape;
}

ShapeSummary read_summary(const Database& database, ShapeId id) {
  Statement row(database,
                "SELECT name, volume, (SELECT face_count FROM meshes WHERE shape_id = shapes.id) FROM shapes "
                "WHERE id = ?");
  if (!row.bind(id).step()) no_such_shape(database, id);
  ShapeSummary summary;
  summary.id = id;
  summary.name = row.text(0);
  summary.volume = row.real(1);
  summary.face_count = static_cast<std::size_t>(row.integer(2));
  summary.descriptors = read_descriptors(database, id);
  for (const Check& check : read_checks(database, id))
    if (!check.passed) summary.failed_checks.push_back(check.name);
  Statement level(database, std::string("SELECT parts_asked, part_count, vertex_cap, "
                                        "(SELECT total(vertex_count) FROM parts WHERE level_id = levels.id), "
                                        "(SELECT total(face_count) FROM parts WHERE level_id = levels.id), ") +
                                kErrorColumns + " FROM levels WHERE shape_id = ? ORDER BY parts_asked, vertex_cap");
  for (level.bind(id); level.step();)
    summary.levels.push_back({static_cast<int>(level.integer(0)), static_cast<int>(level.integer(1)),
                              static_cast<int>(level.integer(2)), static_cast<int>(level.integer(3)),
                              static_cast<int>(level.integer(4)), error_at(level, 5)});
  return summary;
}

LevelOfDetail read_level(const Database& database, ShapeId id, int parts_asked, int vertex_cap) {
  const ShapeSummary summary = read_summary(database, id);
  const std::string what =
      std::to_string(parts_asked) + " parts of at most " + std::to_string(vertex_cap) + " vertices";
  Statement row(database,
                std::string("SELECT id, mass_properties, source_file, source_sha256, tool_version, options, ") +
                    kErrorColumns + " FROM levels WHERE shape_id = ? AND parts_asked = ? AND vertex_cap = ?");
  if (!row.bind(id, parts_asked, vertex_cap).step()) {
    std::string kept;
    for (const auto& level : summary.levels)
      kept += (kept.empty() ? "" : ", ") + std::to_string(level.parts_asked) + "/" + std::to_string(level.vertex_cap);
    throw InputError(database.path().string() + ": " + summary.name + " has no level of " + what +
                     "; kept (parts/vertices): " + (kept.empty() ? "none; run talus decompose first" : kept));
  }
  LevelOfDetail level;
  level.parts_asked = parts_asked;
  level.vertex_cap = vertex_cap;
  level.provenance = provenance_at(row, 2);
  level.error = error_at(row, 6);
  decode(database, "the level of " + summary.name + " with " + what, [&] {
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

std::vector<std::string> descriptor_names(const Database& database) {
  std::vector<std::string> names;
  for (Statement row(database, "SELECT DISTINCT name FROM descriptors ORDER BY name"); row.step();)
    names.push_back(row.text(0));
  return names;
}

void refresh_wide_descriptors(const Database& database) {
  std::string view = "CREATE VIEW wide_descriptors AS SELECT shapes.id, shapes.name";
  for (const std::string& name : descriptor_names(database))
    view += ", max(CASE WHEN descriptors.name = " + quoted(name, '\'') + " THEN value END) AS " + quoted(name, '"');
  view +=
      " FROM shapes LEFT JOIN descriptors ON descriptors.shape_id = shapes.id GROUP BY shapes.id ORDER BY shapes.name";
  Statement stored(database, "SELECT sql FROM sqlite_master WHERE type = 'view' AND name = 'wide_descriptors'");
  if (stored.step() && stored.text(0) == view) return;
  Statement(database, "DROP VIEW IF EXISTS wide_descriptors").run();
  Statement(database, view).run();
}

}  // namespace catalog::sqlite
