// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "catalog/shape_catalog.h"
#include "catalog/sqlite/database.h"

namespace catalog::sqlite {

// Rows of one shape. Writers expect to run inside a transaction; readers throw InputError where a blob is damaged.

/// Replaces the shape of that name, keeping its id, and drops its levels.
ShapeId write_shape(const Database& database, const ShapeRecord& shape);

ShapeRecord read_shape(const Database& database, ShapeId id);
ShapeSummary read_summary(const Database& database, ShapeId id);

/// Sets the grade of every shape from its checks.
void grade_all(const Database& database);

/// Names of all descriptors that any shape has, ascending.
std::vector<std::string> descriptor_names(const Database& database);
/// Makes the view wide_descriptors anew if the set of descriptor names has changed.
void refresh_wide_descriptors(const Database& database);

}  // namespace catalog::sqlite
