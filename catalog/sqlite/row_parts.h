// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "catalog/input_error.h"
#include "catalog/shape_record.h"
#include "catalog/sqlite/encoding.h"
#include "catalog/sqlite/statement.h"

namespace catalog::sqlite {

// What rows of shapes and rows of levels have in common.

inline void add_mass_properties(Statement& statement, const MassProperties& properties) {
  statement.add(properties.volume);
  for (const double coordinate : properties.centroid) statement.add(coordinate);
  for (const double moment : properties.principal_inertia) statement.add(moment);
  statement.add(encode_mass_properties(properties));
}

inline void add_provenance(Statement& statement, const Provenance& provenance) {
  statement.add(provenance.source_file);
  statement.add(provenance.source_sha256);
  statement.add(provenance.tool_version);
  statement.add(provenance.options);
}

inline Provenance provenance_at(const Statement& row, int column) {
  return {row.text(column), row.text(column + 1), row.text(column + 2), row.text(column + 3)};
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

inline void expect_hash(const std::string& stored, const std::string& found) {
  if (stored != found) throw DamagedBlob("its SHA-256 does not fit");
}

}  // namespace catalog::sqlite
