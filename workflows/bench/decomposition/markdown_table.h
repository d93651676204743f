// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace workflows {

/// A Markdown table whose columns are as wide as their widest cell, so that it reads on a terminal too; all but the
/// first two columns are aligned to the right. The first row is the header.
std::string aligned_markdown(const std::vector<std::vector<std::string>>& rows);

/// "4.21"; "-" for what is not a number.
std::string fixed(double value, int decimals);

}  // namespace workflows
