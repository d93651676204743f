// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "dem_gpu/bodies/model_state.h"

namespace dem_gpu {

/// Every column and account of the state, bit for bit, with a fingerprint of the scene. The last checkpoint becomes
/// checkpoint_previous.h5.
void write_checkpoint_file(const std::filesystem::path& run_folder, const Model& model, const State& state);

/// Replaces the state by the last checkpoint, or by the previous one if the last is damaged; the text tells of the
/// latter and is empty otherwise. Throws catalog::InputError if neither can be read, or if it belongs to another scene,
/// version or precision.
std::string read_checkpoint_file(const std::filesystem::path& run_folder, const Model& model, State& state);

}  // namespace dem_gpu
