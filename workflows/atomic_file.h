// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace workflows {

/// Writes beside, flushes to disk, renames: a reader sees the old file or the new one, whole.
/// Throws std::runtime_error if the disk refuses.
void write_whole(const std::filesystem::path& file, const std::string& text);

/// Throws InputError, naming the option, where the folder of a file to be written is not there, or something is in its
/// place that does not begin as an earlier one would: a scan, a catalogue.
void require_own_place(const std::filesystem::path& file, const std::string& option, const std::string& beginning);

/// nullopt if the file cannot be read.
std::optional<std::string> read_whole(const std::filesystem::path& file);

}  // namespace workflows
