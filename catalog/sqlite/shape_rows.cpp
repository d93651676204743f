// SPDX-License-Identifier: Apache-2.0
#include "catalog/sqlite/shape_rows.h"

#include "catalog/grade.h"
#include "catalog/input_error.h"
#include "catalog/sqlite/encoding.h"
#include "catalog/sqlite/level_rows.h"
#include "catalog/sqlite/row_parts.h"
#include "catalog/sqlite/statement.h"

namespace catalog::sqlite {
namespace {

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

  Statement row(database, "INSERT INTO shapes VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  row.bind(id, shape.name);
  add_mass_properties(row, shape.mass_properties);
  add_provenance(row, shape.provenance);
  row.add(grade_of(shape.checks));
  if (shape.source_frame) row.add(encode_source_frame(*shape.source_frame));  // else NULL
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

ShapeRecord read_shape(const Database& database, ShapeId id) {
  Statement row(database,
                "SELECT name, mass_properties, source_file, source_sha256, tool_version, options, source_frame "
                "FROM shapes WHERE id = ?");
  if (!row.bind(id).step()) no_such_shape(database, id);
  ShapeRecord shape;
  shape.name = row.text(0);
  shape.mass_properties =
      decode(database, "the row of " + shape.name, [&] { return decode_mass_properties(row.blob(1)); });
  shape.provenance = provenance_at(row, 2);
  shape.mesh = read_mesh(database, id, shape.name);
  shape.descriptors = read_descriptors(database, id);
  shape.checks = read_checks(database, id);
  if (const Bytes frame = row.blob(6); !frame.empty())
    shape.source_frame = decode(database, "the row of " + shape.name, [&] { return decode_source_frame(frame); });
  return shape;
}

ShapeSummary read_summary(const Database& database, ShapeId id) {
  Statement row(database,
                "SELECT name, volume, (SELECT face_count FROM meshes WHERE shape_id = shapes.id), grade FROM shapes "
                "WHERE id = ?");
  if (!row.bind(id).step()) no_such_shape(database, id);
  ShapeSummary summary;
  summary.id = id;
  summary.name = row.text(0);
  summary.volume = row.real(1);
  summary.face_count = static_cast<std::size_t>(row.integer(2));
  summary.grade = static_cast<int>(row.integer(3));
  summary.descriptors = read_descriptors(database, id);
  for (const Check& check : read_checks(database, id))
    if (!check.passed) summary.failed_checks.push_back(check.name);
  summary.levels = read_levels(database, id);
  return summary;
}

void grade_all(const Database& database) {
  std::vector<ShapeId> ids;
  for (Statement row(database, "SELECT id FROM shapes ORDER BY id"); row.step();) ids.push_back(row.integer(0));
  Statement update(database, "UPDATE shapes SET grade = ? WHERE id = ?");
  for (const ShapeId id : ids) update.bind(grade_of(read_checks(database, id)), id).run();
}

std::vector<std::string> descriptor_names(const Database& database) {
  std::vector<std::string> names;
  for (Statement row(database, "SELECT DISTINCT name FROM descriptors ORDER BY name"); row.step();)
    names.push_back(row.text(0));
  return names;
}

void refresh_wide_descriptors(const Database& database) {
  std::string view = "CREATE VIEW wide_descriptors AS SELECT shapes.id, shapes.name, shapes.grade";
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
