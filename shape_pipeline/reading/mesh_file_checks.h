// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace shape_pipeline {

/// Checks that a mesh file is whole before assimp reads it, which accepts much in silence: lengths and counts, words
/// that are no numbers, indices out of range. Each throws InputError.
void check_stl(const std::filesystem::path& path, std::string_view bytes);
void check_obj(const std::filesystem::path& path, std::string_view bytes);
void check_off(const std::filesystem::path& path, std::string_view bytes);

}  // namespace shape_pipeline
