// SPDX-License-Identifier: Apache-2.0
#include "catalog/sqlite/statement.h"

#include <limits>

namespace catalog::sqlite {

Statement::Statement(const Database& database, std::string_view sql) : database_(database) {
  sqlite3_stmt* handle = nullptr;
  const int result = sqlite3_prepare_v2(database.handle(), sql.data(), static_cast<int>(sql.size()), &handle, nullptr);
  handle_.reset(handle);
  check(result);
}

void Statement::add(const std::string& value) {
  check(sqlite3_bind_text64(handle_.get(), ++bound_, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}

void Statement::add(const Bytes& value) {
  // A null pointer would bind NULL, so an empty blob needs an address.
  static const unsigned char empty = 0;
  const unsigned char* bytes = value.empty() ? &empty : value.data();
  check(sqlite3_bind_blob64(handle_.get(), ++bound_, bytes, value.size(), SQLITE_TRANSIENT));
}

bool Statement::step() {
  const int result = sqlite3_step(handle_.get());
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) database_.fail(result);
  return false;
}

double Statement::real(int column) const {
  if (sqlite3_column_type(handle_.get(), column) == SQLITE_NULL) return std::numeric_limits<double>::quiet_NaN();
  return sqlite3_column_double(handle_.get(), column);
}

std::string Statement::text(int column) const {
  const auto* letters = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return letters ? std::string(letters, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))) : "";
}

Bytes Statement::blob(int column) const {
  const auto* bytes = static_cast<const unsigned char*>(sqlite3_column_blob(handle_.get(), column));
  return bytes ? Bytes(bytes, bytes + sqlite3_column_bytes(handle_.get(), column)) : Bytes{};
}

std::int64_t single_integer(const Database& database, std::string_view sql) {
  Statement statement(database, sql);
  statement.step();
  return statement.integer(0);
}

}  // namespace catalog::sqlite
