// SPDX-License-Identifier: Apache-2.0
#include "catalog/sqlite/schema.h"

#include <string>

#include "catalog/input_error.h"
#include "catalog/sqlite/shape_rows.h"
#include "catalog/sqlite/statement.h"

namespace catalog::sqlite {
namespace {

namespace fs = std::filesystem;

constexpr int kFirstWithGrades = 4;  // schema; what is in an older file is graded when it is brought forward

int newest_schema() { return static_cast<int>(migrations().size()); }

void check_file_kind(const fs::path& path, bool writable) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status))
    throw InputError(path.string() + ": is a folder; expected a catalogue file such as ore.talus");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(path.string() + ": is not a plain file; expected a catalogue file such as ore.talus");
  if (writable) return;
  if (!fs::exists(status))
    throw InputError(path.string() + ": no such file; expected a catalogue; make one with talus digitize ... --into");
  if (fs::file_size(path, error) == 0 && !error)
    throw InputError(path.string() + ": is empty; expected a catalogue; make one with talus digitize ... --into");
}

void check_identity(const Database& database) {
  const std::string file = database.path().string();
  if (single_integer(database, "PRAGMA page_count") == 0) database.fail(SQLITE_NOTADB);
  if (single_integer(database, "PRAGMA application_id") != kApplicationId)
    throw InputError(file + ": is an SQLite file of another application, not a Talus catalogue; give another file");
  const int version = schema_version(database);
  if (version < 1) throw InputError(file + ": is damaged (schema 0); expected a whole catalogue; restore a copy");
  if (version > newest_schema())
    throw InputError(file + ": has schema " + std::to_string(version) + ", this program reads up to " +
                     std::to_string(newest_schema()) + "; use a newer talus");
}

void apply_migrations(const Database& database, int from) {
  for (int version = from; version < newest_schema(); ++version) database.execute(migrations()[version].sql);
  if (from < kFirstWithGrades) grade_all(database);
  database.execute("PRAGMA application_id = " + std::to_string(kApplicationId));
  database.execute("PRAGMA user_version = " + std::to_string(newest_schema()));
}

fs::path free_name(const fs::path& wanted) {
  fs::path name = wanted;
  for (int i = 2; fs::exists(name); ++i) name = wanted.string() + "-" + std::to_string(i);
  return name;
}

/// Copies the file as it stands; SQLite reads it, since closing a descriptor of our own would drop SQLite's locks.
void keep_copy(const fs::path& path, int version) {
  const fs::path kept = free_name(path.string() + ".schema-" + std::to_string(version));
  const fs::path unfinished = free_name(kept.string() + ".unfinished");
  {
    const Database source(path, SQLITE_OPEN_READONLY);
    const Database copy(unfinished, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    copy.copy_from(source);
  }
  fs::rename(unfinished, kept);
}

/// The version is looked at again under the lock: two programs may have opened the file together.
void migrate(const Database& database, bool was_empty) {
  Transaction transaction(database);
  const bool is_new = was_empty && single_integer(database, "PRAGMA application_id") == 0 &&
                      single_integer(database, "SELECT count(*) FROM sqlite_master") == 0;
  if (!is_new) check_identity(database);
  const int version = schema_version(database);
  if (!is_new && version < newest_schema()) keep_copy(database.path(), version);
  if (version < newest_schema()) apply_migrations(database, version);
  transaction.commit();
}

Database open_writable(const fs::path& path) {
  Database database(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  // SQLite takes a file of one byte for an empty one; it is somebody's file. The pages are counted first, since that
  // rolls back what a killed writer left.
  const bool is_empty = single_integer(database, "PRAGMA page_count") == 0 && fs::file_size(path) == 0;
  if (!is_empty) check_identity(database);
  if (database.is_read_only())
    throw InputError(path.string() + ": cannot be written; expected write permission for the file");
  // A rollback journal, not a write-ahead log: a catalogue is one file and can be read from a read-only folder.
  database.execute("PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON");
  if (schema_version(database) < newest_schema()) migrate(database, is_empty);
  return database;
}

Database open_readable(const fs::path& path) {
  Database database(path, SQLITE_OPEN_READONLY);
  check_identity(database);
  const int version = schema_version(database);
  if (version == newest_schema()) return database;
  Database copy = Database::in_memory(path);
  copy.copy_from(database);
  apply_migrations(copy, version);
  return copy;
}

}  // namespace

int schema_version(const Database& database) {
  return static_cast<int>(single_integer(database, "PRAGMA user_version"));
}

Database open_catalog(const fs::path& path, bool writable) {
  check_file_kind(path, writable);
  if (writable) return open_writable(path);
  try {
    return open_readable(path);
  } catch (const NeedsRollback&) {
    // A writer was killed; undoing what it left is the one thing for which a reader writes.
    open_writable(path);
    return open_readable(path);
  }
}

}  // namespace catalog::sqlite
