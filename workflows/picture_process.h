// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace workflows {

/// Runs this same executable with `arguments` where it can draw: on the display that DISPLAY names, else under
/// xvfb-run. A process of its own, because VTK ends the process if the display cannot be opened.
/// Returns nothing if it ended well, else one line that says why not. What it prints goes to stderr.
std::string run_with_display(const std::vector<std::string>& arguments);

}  // namespace workflows
