// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "dem_gpu/core/host_device.h"

namespace dem_gpu {

/// One member of the rows of a table, used like a column: RowField<&Row::member>{rows}[i].
template <auto kMember>
struct RowField;

template <class Row, class T, T Row::*kMember>
struct RowField<kMember> {
  Row* rows;

  TALUS_HD T& operator[](std::size_t i) const { return rows[i].*kMember; }
};

}  // namespace dem_gpu
