// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "workflows/population/form_table.h"

namespace workflows {

/// `count` of the rows, by number and from the smallest diameter up, so that they keep the joint distribution closer
/// than chance would: the rows are halved again and again across the figure that varies most in each half (in
/// standard deviations of all rows), until there is a cell for each row wanted, and one row of each cell is drawn with
/// equal chance. Where more are wanted than there are, each is taken as often as it goes whole. `rows` is not empty.
std::vector<std::size_t> stratified_rows(const std::vector<FormRow>& rows, std::size_t count, std::uint64_t seed);

/// Of 64 such draws (fewer beyond 10,000 rows, 4 at least) the one nearest to all rows: least sum of the squared
/// differences of the figures' means and standard deviations (over the standard deviations) and of their correlations.
/// Better than one draw where few rows are wanted (rerandomisation: Morgan & Rubin 2012). `count` is at least 2.
std::vector<std::size_t> representative_rows(const std::vector<FormRow>& rows, std::size_t count, std::uint64_t seed);

}  // namespace workflows
