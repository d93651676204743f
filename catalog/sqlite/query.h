// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "catalog/sqlite/database.h"

namespace catalog::sqlite {

/// Ids of the shapes that a query selects, in ascending order of name; the grammar stands at ShapeCatalog::select.
std::vector<ShapeId> select_shapes(const Database& database, const std::string& query);

}  // namespace catalog::sqlite
