// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <memory>
#include <string>

#include "catalog/input_error.h"

namespace catalog::sqlite {

// How long a statement waits for another program's lock [ms]: longer than any store here takes, short enough to tell a
// user who waits.
constexpr int kBusyTimeout = 3000;

/// A killed writer's work must first be undone, which a read-only connection cannot do.
struct NeedsRollback : InputError {
  using InputError::InputError;
};

/// An open SQLite file; closed on destruction. `flags` are SQLITE_OPEN_...
class Database {
 public:
  Database(const std::filesystem::path& path, int flags);
  static Database in_memory(const std::filesystem::path& named_for);

  sqlite3* handle() const { return handle_.get(); }
  const std::filesystem::path& path() const { return path_; }
  bool is_read_only() const { return sqlite3_db_readonly(handle(), "main") == 1; }

  void execute(const std::string& statements) const;
  /// Copies every page of `source` into this database, which it replaces.
  void copy_from(const Database& source) const;

  /// Throws what SQLite's last result means: InputError for what a user can mend, std::runtime_error otherwise.
  [[noreturn]] void fail(int result) const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  std::filesystem::path path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A write transaction, rolled back on destruction unless committed.
class Transaction {
 public:
  explicit Transaction(const Database& database) : database_(database) { database.execute("BEGIN IMMEDIATE"); }
  ~Transaction() {
    if (!committed_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void commit() {
    database_.execute("COMMIT");
    committed_ = true;
  }

 private:
  const Database& database_;
  bool committed_ = false;
};

}  // namespace catalog::sqlite
