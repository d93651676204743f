// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace postprocess {

// Files of postprocess/report/ that go into each report; CMake turns them into strings.
extern const char* const kViewerScript;  // viewer.js
extern const char* const kReportStyle;   // report.css

}  // namespace postprocess
