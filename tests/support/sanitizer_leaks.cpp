// SPDX-License-Identifier: Apache-2.0
// Leaks that are not ours, for the leak sanitizer: HDF5 loses a few hundred bytes as it refuses a damaged file.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }
