// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "catalog/nearest_word.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/silhouettes/turntable_camera.h"
#include "shape_pipeline/volumes/stack_file.h"

namespace shape_pipeline {
namespace {

using nlohmann::json;
constexpr char kExample[] =
    R"(it reads like {"unit": "mm", "pixel_size": 0.02} or {"unit": "mm", "focal_length": 2400, )"
    R"("principal_point": [640, 512], "distance": 250})";
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSteepest = 60;  // [deg]: beyond, the views tell hardly anything of the grain's height

/// turntable.json, with every key checked.
class Sidecar {
 public:
  explicit Sidecar(const std::filesystem::path& path) : path_(path) {
    try {
      values_ = json::parse(ScanBytes(path).view());
    } catch (const json::parse_error& error) {
      refuse_file(path, "byte " + std::to_string(error.byte), "is no JSON", kExample);
    } catch (const json::out_of_range&) {
      refuse_file(path, "", "holds a number that is too large", kExample);
    }
    if (!values_.is_object()) refuse_file(path, "", "is no JSON object", kExample);
    const std::vector<std::string> known{"unit",      "pixel_size",  "focal_length", "principal_point", "distance",
                                         "elevation", "axis_column", "turn",         "angles"};
    for (const auto& [key, value] : values_.items())
      if (std::find(known.begin(), known.end(), key) == known.end())
        refuse_file(path, key, "is no key of a turntable", catalog::word_hint(key, known));
    const std::vector<std::string> other = has("pixel_size")
                                               ? std::vector<std::string>{"focal_length", "principal_point", "distance"}
                                               : std::vector<std::string>{};
    for (const std::string& key : other)
      if (has(key))
        refuse_file(path, key, "is for a perspective camera, \"pixel_size\" for an orthographic one", kExample);
  }

  bool has(const std::string& key) const { return values_.contains(key); }

  double number(const std::string& key) const { return finite(key, values_.value(key, json())); }

  double above_zero(const std::string& key) const {
    const double value = number(key);
    if (!(value > 0)) refuse_file(path_, key, "expected a number above 0", kExample);
    return value;
  }

  std::vector<double> numbers(const std::string& key) const {
    const json list = values_.value(key, json());
    if (!list.is_array()) refuse_file(path_, key, "expected a list of numbers", kExample);
    std::vector<double> result;
    for (const json& value : list) result.push_back(finite(key, value));
    return result;
  }

  std::string word(const std::string& key, const std::string& usual, const std::vector<std::string>& known) const {
    const json value = values_.value(key, json(usual));
    if (!value.is_string() || std::find(known.begin(), known.end(), value.get<std::string>()) == known.end())
      refuse_file(path_, key, "expected one of " + catalog::quoted_list(known), kExample);
    return value.get<std::string>();
  }

 private:
  double finite(const std::string& key, const json& value) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      refuse_file(path_, key, has(key) ? "expected a number" : "is missing", kExample);
    return value.get<double>();
  }

  std::filesystem::path path_;
  json values_;
};

}  // namespace

TurntableCamera read_turntable_camera(const std::filesystem::path& path) {
  const Sidecar sidecar(path);
  const double unit = metres_of_unit(sidecar.word("unit", "", {"m", "mm", "um", "nm", "cm", "in"}));
  TurntableCamera camera;
  camera.is_perspective = !sidecar.has("pixel_size");
  if (camera.is_perspective) {
    camera.focal_length = sidecar.above_zero("focal_length");
    camera.distance = unit * sidecar.above_zero("distance");
    const std::vector<double> centre = sidecar.numbers("principal_point");
    if (centre.size() != 2) refuse_file(path, "principal_point", "expected a column and a row", kExample);
    camera.principal_point = {centre[0], centre[1]};
  } else {
    camera.pixel_size = unit * sidecar.above_zero("pixel_size");
  }
  if (sidecar.has("elevation")) camera.elevation = kDegree * sidecar.number("elevation");
  if (std::abs(camera.elevation) > kSteepest * kDegree)
    refuse_file(path, "elevation", "expected -60 to 60 degrees", "set the camera lower");
  if (sidecar.has("axis_column")) camera.axis_column = sidecar.number("axis_column");
  camera.turns_clockwise = sidecar.word("turn", "counterclockwise", {"counterclockwise", "clockwise"}) == "clockwise";
  if (sidecar.has("angles")) {
    camera.angles = sidecar.numbers("angles");
    for (double& angle : camera.angles) angle *= kDegree;
    if (camera.angles.empty()) refuse_file(path, "angles", "expected an angle for each view", kExample);
  }
  return camera;
}

}  // namespace shape_pipeline
