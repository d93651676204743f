// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "catalog/input_error.h"
#include "tests/support/scene_text.h"
#include "workflows/scene_reader.h"

namespace workflows {

inline SceneDescription read(const std::string& text) { return read_scene_text(text, "scene.toml", "/ore"); }

inline std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "not refused";
}

}  // namespace workflows
