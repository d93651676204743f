// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/sqlite/database.h"

namespace catalog::sqlite {

using Bytes = std::vector<unsigned char>;

/// A prepared statement; its parameters are `?`, bound in order. Columns are read by position from 0.
class Statement {
 public:
  Statement(const Database& database, std::string_view sql);

  template <class... Values>
  Statement& bind(const Values&... values) {
    sqlite3_reset(handle_.get());
    bound_ = 0;
    (add(values), ...);
    return *this;
  }
  // Adds one parameter after those already bound.
  void add(std::int64_t value) { check(sqlite3_bind_int64(handle_.get(), ++bound_, value)); }
  void add(int value) { add(static_cast<std::int64_t>(value)); }
  void add(bool value) { add(static_cast<std::int64_t>(value)); }
  void add(std::size_t value) { add(static_cast<std::int64_t>(value)); }
  void add(double value) { check(sqlite3_bind_double(handle_.get(), ++bound_, value)); }  // NaN becomes NULL
  void add(const std::string& value);
  void add(const Bytes& value);

  bool step();  // true while there is a row
  void run() {  // for statements without rows
    while (step()) continue;
  }

  std::int64_t integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }
  double real(int column) const;  // NULL is NaN
  std::string text(int column) const;
  Bytes blob(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };
  void check(int result) const {
    if (result != SQLITE_OK) database_.fail(result);
  }

  const Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
  int bound_ = 0;
};

/// The one integer that `sql` yields.
std::int64_t single_integer(const Database& database, std::string_view sql);

}  // namespace catalog::sqlite
