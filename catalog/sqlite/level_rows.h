// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "catalog/shape_catalog.h"
#include "catalog/sqlite/database.h"

namespace catalog::sqlite {

// Rows of the levels of detail of one shape. The writer expects to run inside a transaction; readers throw InputError
// where a row is damaged.

/// Takes the place of the level with the same key.
void write_level(const Database& database, ShapeId id, const LevelOfDetail& level);

/// What a summary shows of each: volume-true ones first, then by parts asked for, cap of vertices, cap of faces.
std::vector<ShapeSummary::Level> read_levels(const Database& database, ShapeId id);

/// `name` of the shape, for messages.
LevelOfDetail read_level(const Database& database, ShapeId id, const std::string& name, const LevelKey& key);

}  // namespace catalog::sqlite
