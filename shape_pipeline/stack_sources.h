// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shape_pipeline {

/// True for the endings of stacks that no other scan has: tif, tiff, nrrd, nhdr, raw.
bool has_stack_ending(const std::filesystem::path& path);

/// The ending with its dot, in lower case.
std::string lower_ending(const std::filesystem::path& path);

/// The files that make a stack, in the order of its slices: a folder's images in natural order (2 before 10), a raw
/// file and its sidecar, a detached NRRD header and its values, else the file itself. Throws InputError for a folder
/// without images, or with images of two kinds.
std::vector<std::filesystem::path> stack_sources(const std::filesystem::path& path);

}  // namespace shape_pipeline
