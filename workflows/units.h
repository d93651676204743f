// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace workflows {

enum class Dimension {
  length,            // m
  time,              // s
  mass,              // kg
  speed,             // m/s
  acceleration,      // m/s2
  angle,             // rad
  angular_velocity,  // rad/s
  density,           // kg/m3
  pressure,          // Pa
  stiffness_volume,  // N/m3, per volume of overlap
  stiffness_length,  // N/m
  surface_energy,    // J/m2
  ratio,             // -, "5 %" is 0.05
};

/// Value in SI of text such as "12 mm", "25 rpm", "2700 kg/m3", "5 %"; a bare number is SI already.
/// nullopt if the text is not a number followed by a unit of that dimension.
std::optional<double> parse_quantity(const std::string& text, Dimension dimension);

/// Units accepted for a dimension, for messages: "m, cm, mm, um, km, in".
std::string accepted_units(Dimension dimension);

/// Metres per unit: "mm" is 0.001; nullopt for an unknown name.
std::optional<double> length_unit(const std::string& name);

}  // namespace workflows
