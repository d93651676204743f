// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace test_support {

/// A small whole scene: boxes and balls falling in a drum with lifters. Lines and columns of tests count in it.
inline std::string drum_scene() {
  return R"(name = "drum"
gravity = [0, 0, "-9.81 m/s2"]

[run]
end_time = "40 ms"
snapshot_every = "10 ms"
checkpoint_every = "20 ms"
series_every = "5 ms"

[material.rock]
density = "2700 kg/m3"

[material.steel]
density = "7.8 g/cm3"

[contact.default]
restitution = 0.4
friction = 0.5

[contact."rock-steel"]
friction = 0.3

[contact_law]
polyhedra = "depth_potential"
largest_overlap = "3 %"
at_speed = "1 m/s"

[motion.drum]
rotate = "30 rpm"
axis = [0, 1, 0]
centre = [0, 0, 0]

[[wall]]
name = "shell"
type = "cylinder"
base = [0, "-50 mm", 0]
axis = [0, 1, 0]
radius = "10 cm"
length = "100 mm"
material = "steel"
motion = "drum"

[[lifters]]
on = "shell"
count = 6
width = "20 mm"
height = "10 mm"

[[fill]]
name = "blocks"
box = {size = ["10 mm", "12 mm", "14 mm"]}
material = "rock"
count = 12
seed = 3
where = {cylinder = {base = [0, "-45 mm", 0], axis = [0, 1, 0], radius = "85 mm", length = "90 mm"}}
size = {kind = "single", basis = "mass", definition = "sieve", size = "12 mm"}

[[fill]]
name = "balls"
sphere = {diameter = "15 mm"}
material = "steel"
count = 6
where = {cylinder = {base = [0, "-45 mm", 0], axis = [0, 1, 0], radius = "85 mm", length = "90 mm"}}
)";
}

/// `text` with the one place that reads `old_text` changed.
inline std::string with(std::string text, const std::string& old_text, const std::string& new_text) {
  const std::size_t at = text.find(old_text);
  if (at == std::string::npos) throw std::logic_error("no '" + old_text + "' in the text");
  return text.replace(at, old_text.size(), new_text);
}

/// "line:column" of the first `mark` in `text`, counting from 1.
inline std::string place_of(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) throw std::logic_error("no '" + mark + "' in the text");
  std::size_t line = 1, start = 0;
  for (std::size_t i = 0; i < at; ++i)
    if (text[i] == '\n') ++line, start = i + 1;
  return std::to_string(line) + ":" + std::to_string(at - start + 1);
}

}  // namespace test_support
