// SPDX-License-Identifier: Apache-2.0
#include "catalog/sqlite/database.h"

#include <algorithm>
#include <stdexcept>

namespace catalog::sqlite {

Database::Database(const std::filesystem::path& path, int flags) : path_(path) {
  // An absolute path keeps SQLite from giving names such as ":memory:" a meaning.
  const std::string file = flags & SQLITE_OPEN_MEMORY ? ":memory:" : std::filesystem::absolute(path).string();
  sqlite3* handle = nullptr;
  const int result = sqlite3_open_v2(file.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(handle);
  if (result != SQLITE_OK) fail(result);
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, kBusyTimeout);
}

Database Database::in_memory(const std::filesystem::path& named_for) {
  return Database(named_for, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_MEMORY);
}

void Database::execute(const std::string& statements) const {
  const int result = sqlite3_exec(handle(), statements.c_str(), nullptr, nullptr, nullptr);
  if (result != SQLITE_OK) fail(result);
}

void Database::copy_from(const Database& source) const {
  sqlite3_backup* backup = sqlite3_backup_init(handle(), "main", source.handle(), "main");
  if (!backup) fail(sqlite3_extended_errcode(handle()));
  const int step = sqlite3_backup_step(backup, -1);
  sqlite3_backup_finish(backup);
  if (step != SQLITE_DONE) source.fail(step);
}

void Database::fail(int result) const {
  const std::string file = path_.string();
  std::string said = handle() ? sqlite3_errmsg(handle()) : sqlite3_errstr(result);
  std::replace(said.begin(), said.end(), '\n', ' ');  // it may quote the file's own SQL
  if (result == SQLITE_READONLY_ROLLBACK || result == SQLITE_READONLY_RECOVERY)
    throw NeedsRollback(file +
                        ": its last write was cut off and must be undone; expected write permission for the file "
                        "and its folder; open it once where you have it");
  if (result == SQLITE_IOERR_SHORT_READ) result = SQLITE_CORRUPT;
  switch (result & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw InputError(file + ": still locked by another program after " + std::to_string(kBusyTimeout / 1000) +
                       " s; expected a catalogue that is free; wait for that program to end, then run again");
    case SQLITE_NOTADB:
      throw InputError(file + ": is not a Talus catalogue (not even an SQLite file); expected a file made by talus");
    case SQLITE_CORRUPT:
    case SQLITE_FORMAT:
      throw InputError(file + ": is damaged or cut short (" + said +
                       "); expected a whole catalogue; restore it from a copy");
    case SQLITE_ERROR:  // the statements are fixed, so what they do not fit is the file
      throw InputError(file + ": its tables are not those of a Talus catalogue (" + said +
                       "); expected one that nothing else has changed; restore it from a copy");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      throw InputError(file + ": cannot be written; expected write permission for the file and its folder");
    case SQLITE_CANTOPEN:
      throw InputError(file + ": cannot be opened; expected a file in an existing folder that you may use");
    case SQLITE_FULL:
      throw std::runtime_error(file + ": the disk is full; nothing was changed");
    default:
      throw std::runtime_error(file + ": " + said);
  }
}

}  // namespace catalog::sqlite
