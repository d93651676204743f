// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace workflows {

/// printf's text as a string of any length.
std::string formatted(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace workflows
