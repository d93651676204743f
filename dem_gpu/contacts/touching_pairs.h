// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/sphere_pairs.h"
#include "dem_gpu/core/lanes.h"
#include "dem_gpu/core/parallel.h"

namespace dem_gpu {

/// Candidate pairs of a range that touch, in their order; room for one more block of pairs to look at.
struct TouchingPairs {
  int contact[kRangeLength + kRealLanes], a[kRangeLength + kRealLanes], b[kRangeLength + kRealLanes];
  int count = 0;

  /// The pairs from `first` on.
  TALUS_HD PairRows rows(int first) const {
    return {RowLanes::load(contact + first), RowLanes::load(a + first), RowLanes::load(b + first)};
  }
  TALUS_HD void append(int c, int body_a, int body_b) {
    contact[count] = c;
    a[count] = body_a;
    b[count] = body_b;
    ++count;
  }
  TALUS_HD void append(const PairRows& rows, unsigned which) {
    append_lanes(rows.contact, which, contact + count);
    append_lanes(rows.a, which, a + count);
    append_lanes(rows.b, which, b + count);
    count += count_bits(which);
  }
  /// Fills the last block with its last pair, which changes nothing.
  TALUS_HD void fill_last_block() {
    for (int i = count; count > 0 && i % kRealLanes != 0; ++i) {
      contact[i] = contact[count - 1];
      a[i] = a[count - 1];
      b[i] = b[count - 1];
    }
  }
};

}  // namespace dem_gpu
