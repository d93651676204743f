// SPDX-License-Identifier: Apache-2.0
#include "catalog/shape_catalog.h"

#include <stdexcept>

#include "catalog/input_error.h"
#include "catalog/sqlite/level_rows.h"
#include "catalog/sqlite/query.h"
#include "catalog/sqlite/schema.h"
#include "catalog/sqlite/shape_rows.h"
#include "catalog/sqlite/statement.h"

namespace catalog {
namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

/// A shape that could not be read back is refused before anything is written.
void expect_storable(const ShapeRecord& shape) {
  if (shape.name.empty()) throw std::invalid_argument("a shape needs a name to be stored");
  for (const Triangle& face : shape.mesh.faces)
    for (const int index : face)
      if (index < 0 || static_cast<std::size_t>(index) >= shape.mesh.vertex_count())
        throw std::invalid_argument("the mesh of " + shape.name + " has a face with a vertex index out of range");
}

}  // namespace

struct ShapeCatalog::Connection {
  Database database;
};

ShapeCatalog::ShapeCatalog(const std::filesystem::path& path, Access access)
    : connection_(new Connection{sqlite::open_catalog(path, access == Access::read_write)}) {}

ShapeCatalog::~ShapeCatalog() = default;
ShapeCatalog::ShapeCatalog(ShapeCatalog&&) noexcept = default;
ShapeCatalog& ShapeCatalog::operator=(ShapeCatalog&&) noexcept = default;

ShapeId ShapeCatalog::store_shape(const ShapeRecord& shape) {
  expect_storable(shape);
  Transaction transaction(connection_->database);
  const ShapeId id = sqlite::write_shape(connection_->database, shape);
  sqlite::refresh_wide_descriptors(connection_->database);
  transaction.commit();
  return id;
}

void ShapeCatalog::remove_shape(const std::string& name) {
  const std::optional<ShapeId> id = find(name);
  if (!id) return;
  Transaction transaction(connection_->database);
  Statement(connection_->database, "DELETE FROM shapes WHERE id = ?").bind(*id).run();
  sqlite::refresh_wide_descriptors(connection_->database);
  transaction.commit();
}

void ShapeCatalog::store_rejected(const RejectedInput& rejected) {
  Transaction transaction(connection_->database);
  Statement(connection_->database, "INSERT OR REPLACE INTO rejected VALUES (?, ?, ?, ?)")
      .bind(rejected.name, rejected.source_file, rejected.source_sha256, rejected.reason)
      .run();
  transaction.commit();
}

void ShapeCatalog::forget_rejected(const std::string& name) {
  Statement row(connection_->database, "SELECT 1 FROM rejected WHERE name = ?");
  if (!row.bind(name).step()) return;
  Transaction transaction(connection_->database);
  Statement(connection_->database, "DELETE FROM rejected WHERE name = ?").bind(name).run();
  transaction.commit();
}

void ShapeCatalog::store_levels(ShapeId id, const std::vector<LevelOfDetail>& levels) {
  Transaction transaction(connection_->database);
  Statement shape(connection_->database, "SELECT 1 FROM shapes WHERE id = ?");
  if (!shape.bind(id).step())
    throw std::invalid_argument("no shape has id " + std::to_string(id) + ", so its levels cannot be stored");
  for (const LevelOfDetail& level : levels) sqlite::write_level(connection_->database, id, level);
  transaction.commit();
}

std::optional<ShapeId> ShapeCatalog::find(const std::string& name) const {
  Statement row(connection_->database, "SELECT id FROM shapes WHERE name = ?");
  if (!row.bind(name).step()) return std::nullopt;
  return row.integer(0);
}

ShapeRecord ShapeCatalog::shape(ShapeId id) const { return sqlite::read_shape(connection_->database, id); }

ShapeSummary ShapeCatalog::summary(ShapeId id) const { return sqlite::read_summary(connection_->database, id); }

LevelOfDetail ShapeCatalog::level(ShapeId id, const LevelKey& key) const {
  return sqlite::read_level(connection_->database, id, summary(id).name, key);
}

std::vector<RejectedInput> ShapeCatalog::rejected() const {
  std::vector<RejectedInput> list;
  Statement row(connection_->database, "SELECT name, source_file, source_sha256, reason FROM rejected ORDER BY name");
  while (row.step()) list.push_back({row.text(0), row.text(1), row.text(2), row.text(3)});
  return list;
}

std::vector<ShapeId> ShapeCatalog::select(const std::string& query) const {
  return sqlite::select_shapes(connection_->database, query);
}

int ShapeCatalog::schema_version() const { return sqlite::schema_version(connection_->database); }

}  // namespace catalog
