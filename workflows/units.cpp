// SPDX-License-Identifier: Apache-2.0
#include "workflows/units.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

namespace workflows {
namespace {

using UnitTable = std::vector<std::pair<std::string_view, double>>;

const UnitTable& units_of(Dimension dimension) {
  constexpr double pi = std::numbers::pi;
  static const UnitTable length{{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"km", 1e3}, {"in", 0.0254}};
  static const UnitTable time{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"min", 60}, {"h", 3600}};
  static const UnitTable mass{{"kg", 1}, {"g", 1e-3}, {"mg", 1e-6}, {"t", 1e3}};
  static const UnitTable speed{{"m/s", 1}, {"mm/s", 1e-3}, {"cm/s", 1e-2}};
  static const UnitTable acceleration{{"m/s2", 1}};
  static const UnitTable angle{{"rad", 1}, {"deg", pi / 180}};
  static const UnitTable angular_velocity{{"rad/s", 1}, {"rpm", 2 * pi / 60}, {"deg/s", pi / 180}, {"Hz", 2 * pi}};
  static const UnitTable density{{"kg/m3", 1}, {"g/cm3", 1e3}, {"t/m3", 1e3}};
  static const UnitTable pressure{{"Pa", 1}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}};
  static const UnitTable stiffness_volume{{"N/m3", 1}, {"N/mm3", 1e9}};
  static const UnitTable stiffness_length{{"N/m", 1}, {"kN/m", 1e3}, {"N/mm", 1e3}};
  static const UnitTable surface_energy{{"J/m2", 1}, {"mJ/m2", 1e-3}};
  static const UnitTable ratio{{"", 1}, {"%", 1e-2}};
  switch (dimension) {
    case Dimension::length:
      return length;
    case Dimension::time:
      return time;
    case Dimension::mass:
      return mass;
    case Dimension::speed:
      return speed;
    case Dimension::acceleration:
      return acceleration;
    case Dimension::angle:
      return angle;
    case Dimension::angular_velocity:
      return angular_velocity;
    case Dimension::density:
      return density;
    case Dimension::pressure:
      return pressure;
    case Dimension::stiffness_volume:
      return stiffness_volume;
    case Dimension::stiffness_length:
      return stiffness_length;
    case Dimension::surface_energy:
      return surface_energy;
    case Dimension::ratio:
      return ratio;
  }
  return ratio;
}

}  // namespace

std::optional<double> parse_quantity(const std::string& text, Dimension dimension) {
  double number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
  std::string_view unit(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  while (!unit.empty() && unit.back() == ' ') unit.remove_suffix(1);
  // A forgotten unit must not pass for metres; nothing is nothing in any.
  if (unit.empty() && dimension != Dimension::ratio && number != 0) return std::nullopt;
  if (unit.empty()) return number;
  for (const auto& [name, factor] : units_of(dimension))
    if (name == unit) return number * factor;
  return std::nullopt;
}

std::string accepted_units(Dimension dimension) {
  std::string list;
  for (const auto& [name, factor] : units_of(dimension))
    if (!name.empty()) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

std::optional<double> length_unit(const std::string& name) {
  for (const auto& [unit, factor] : units_of(Dimension::length))
    if (unit == name) return factor;
  return std::nullopt;
}

}  // namespace workflows
