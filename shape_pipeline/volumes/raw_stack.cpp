// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "catalog/nearest_word.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/volumes/stack_file.h"

namespace shape_pipeline {
namespace {

using nlohmann::json;
constexpr char kExample[] =
    R"(it reads like {"size": [512, 512, 300], "type": "uint16", "voxel_size": 12, "unit": "um"})";

/// The sidecar of a raw file, with every key checked.
class Sidecar {
 public:
  explicit Sidecar(const std::filesystem::path& path) : path_(path) {
    if (!std::filesystem::exists(path))
      refuse_file(path, "", "a RAW needs this file beside it, which is not there", kExample);
    try {
      values_ = json::parse(ScanBytes(path).view());
    } catch (const json::parse_error& error) {
      refuse_file(path, "byte " + std::to_string(error.byte), "is no JSON", kExample);
    } catch (const json::out_of_range&) {
      refuse_file(path, "", "holds a number that is too large", kExample);
    }
    if (!values_.is_object()) refuse_file(path, "", "is no JSON object", kExample);
    const std::vector<std::string> known{"size", "type", "endian", "offset", "voxel_size", "unit"};
    for (const auto& [key, value] : values_.items())
      if (std::find(known.begin(), known.end(), key) == known.end())
        refuse_file(path, key, "is no key of a sidecar", catalog::word_hint(key, known));
  }

  std::array<int, 3> size() const {
    std::array<int, 3> size{};
    const json value = values_.value("size", json());
    bool is_good = value.is_array() && value.size() == 3;
    for (std::size_t i = 0; is_good && i < 3; ++i) {
      is_good = value[i].is_number_unsigned() && value[i].get<std::uint64_t>() < 100000;
      if (is_good) size[i] = value[i].get<int>();
    }
    if (!is_good) refuse_file(path_, "size", "expected three numbers of voxels (columns, rows, slices)", kExample);
    return size;
  }

  SampleType type() const {
    const std::string type = word("type", "", {"uint8", "int8", "uint16", "int16", "float32"});
    const int bytes = type.ends_with("8") ? 1 : type.ends_with("16") ? 2 : 4;
    return {bytes, type[0] == 'i', word("endian", "little", {"little", "big"}) == "big", type[0] == 'f'};
  }

  std::size_t offset() const {
    const json value = values_.value("offset", json(0u));
    if (!value.is_number_unsigned()) refuse_file(path_, "offset", "expected a number of bytes", kExample);
    return value.get<std::size_t>();
  }

  /// Zeros where it states none.
  std::array<double, 3> voxel_size() const {
    if (!values_.contains("voxel_size")) return {};
    const double unit = metres_of_unit(word("unit", "", {"m", "mm", "um", "nm", "cm", "in"}));
    const json value = values_["voxel_size"];
    std::array<double, 3> size{};
    for (std::size_t i = 0; i < 3; ++i) {
      const json& side = value.is_array() && value.size() == 3 ? value[i] : value;
      if (side.is_number()) size[i] = unit * side.get<double>();
      if (!(size[i] > 0) || !std::isfinite(size[i]))
        refuse_file(path_, "voxel_size", "expected one or three numbers above 0", kExample);
    }
    return size;
  }

 private:
  std::string word(const std::string& key, const std::string& usual, const std::vector<std::string>& known) const {
    const json value = values_.value(key, json(usual));
    if (!value.is_string() || std::find(known.begin(), known.end(), value.get<std::string>()) == known.end())
      refuse_file(path_, key, "expected one of " + catalog::quoted_list(known), kExample);
    return value.get<std::string>();
  }

  std::filesystem::path path_;
  json values_;
};

}  // namespace

GreyVolume read_raw_stack(const std::filesystem::path& path, double memory_limit) {
  const Sidecar sidecar(std::filesystem::path(path).replace_extension(".json"));
  if (!std::filesystem::exists(path)) refuse_file(path, "", "there is no such file", "check the path of the stack");
  const SampleType type = sidecar.type();
  const std::array<int, 3> size = sidecar.size();
  const std::size_t voxels = VoxelGrid{size, {}}.count();
  const std::size_t expected = sidecar.offset() + voxels * static_cast<std::size_t>(type.bytes);
  const std::size_t found = std::filesystem::file_size(path);
  if (found != expected)
    refuse_file(path, "", "has " + std::to_string(found) + " bytes, its sidecar says " + std::to_string(expected),
                "correct size, type or offset in " + std::filesystem::path(path).replace_extension(".json").string());
  SampleSink sink(path, size, type, memory_limit);
  sink.set_spacing(sidecar.voxel_size());
  sink.store_file(path, sidecar.offset());
  return sink.finished();
}

}  // namespace shape_pipeline
