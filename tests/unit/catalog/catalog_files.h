// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "catalog/input_error.h"
#include "catalog/shape_catalog.h"
#include "tests/support/sample_shapes.h"

/// Catalogue files, made and looked at from outside.
namespace catalog_files {

using namespace catalog;
namespace fs = std::filesystem;
using Access = ShapeCatalog::Access;
using test_support::sample_level;
using test_support::sample_shape;

/// SQLite spoken to directly, so that what the catalogue wrote is looked at by another route.
class Sqlite {
 public:
  explicit Sqlite(const fs::path& path) { EXPECT_EQ(sqlite3_open(path.c_str(), &handle_), SQLITE_OK); }
  ~Sqlite() { sqlite3_close(handle_); }
  void execute(const std::string& sql) {
    char* error = nullptr;
    EXPECT_EQ(sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, &error), SQLITE_OK) << sql << ": " << error;
    sqlite3_free(error);
  }
  std::string value(const std::string& sql) {
    std::string first;
    const auto keep = [](void* to, int, char** fields, char**) {
      *static_cast<std::string*>(to) = fields[0] ? fields[0] : "";
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(handle_, sql.c_str(), keep, &first, nullptr), SQLITE_OK) << sql;
    return first;
  }

 private:
  sqlite3* handle_ = nullptr;
};

inline std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline void make_catalog(const fs::path& path, int shapes = 1) {
  ShapeCatalog catalog(path, Access::read_write);
  for (int i = 0; i < shapes; ++i) {
    const ShapeRecord shape = sample_shape("rock_" + std::to_string(i), 1 + i);
    catalog.store_levels(catalog.store_shape(shape), {sample_level(shape, 2)});
  }
}

inline std::string refusal(const fs::path& path, Access access) {
  try {
    ShapeCatalog catalog(path, access);
    for (const ShapeId id : catalog.select("")) {
      catalog.shape(id);
      catalog.level(id, {2, 64});
    }
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(text.find(path.filename().string()), std::string::npos) << text;
    return text;
  }
  return "accepted";
}

inline void expect_refused(const fs::path& path, const std::string& reason) {
  const std::string before = bytes_of(path);
  for (const Access access : {Access::read_only, Access::read_write})
    EXPECT_NE(refusal(path, access).find(reason), std::string::npos) << refusal(path, access);
  EXPECT_TRUE(bytes_of(path) == before) << "a refused file must not change";
}

}  // namespace catalog_files
