// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace fuzz {

/// A right file of every kind that is read, as the fuzz target takes it: its ending on a line, then its bytes.
std::vector<std::string> reader_seeds();

}  // namespace fuzz
