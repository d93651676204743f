// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "catalog/shape_record.h"

namespace catalog {

/// How far a digitised shape can be trusted, from its checks:
///   1  every check passed
///   2  usable with a reservation: only informing checks did not pass, another way than the usual one had to be taken
///      (rebuilt, wrapped, normals estimated, holes of a large share filled), or something was assumed that its source
///      does not show
///   3  a decisive check did not pass, or there is none
/// The crossings and the kept area of a mesh that repair then replaced (before "repaired_solid") inform. A check that
/// is not known is decisive. The table stands in docs/digitising.md.
int grade_of(const std::vector<Check>& checks);

/// The grade in words, one line.
std::string grade_meaning(int grade);

}  // namespace catalog
