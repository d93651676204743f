// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "catalog/sqlite/database.h"

namespace catalog::sqlite {

// "Tals" in the file's header (offset 68), so that `file` and other programs can tell a catalogue.
constexpr int kApplicationId = 0x54616c73;

/// One numbered file of catalog/migrations; the one at index i leads from schema i to i + 1.
struct Migration {
  const char* file;
  const char* sql;
};
const std::vector<Migration>& migrations();

/// Opens a catalogue at today's schema. An older file is brought forward: when it may be written, in one transaction
/// after a copy was kept beside it as `FILE.schema-N`; otherwise as a copy in memory. A missing or zero-length file
/// becomes a new catalogue when `writable`, else InputError; so are foreign, newer, damaged and locked files.
Database open_catalog(const std::filesystem::path& path, bool writable);

int schema_version(const Database& database);

}  // namespace catalog::sqlite
