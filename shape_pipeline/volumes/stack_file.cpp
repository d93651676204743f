// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/volumes/stack_file.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <utility>

#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/stack_sources.h"

namespace shape_pipeline {
namespace {

constexpr double kVoxelTolerance = 1e-3;  // relative: sizes are written with three digits at least
constexpr double kMostVoxels = 4e9;       // voxels are counted in 32 bits
constexpr std::size_t kQuantileSample = 1000000;

std::string size_text(const std::array<double, 3>& size) {
  char text[100];
  std::snprintf(text, sizeof text, "%.5g x %.5g x %.5g um", size[0] * 1e6, size[1] * 1e6, size[2] * 1e6);
  return text;
}

GreyVolume read_by_kind(const std::filesystem::path& path, double memory_limit) {
  if (std::filesystem::is_directory(path)) {
    const std::vector<std::filesystem::path> slices = stack_sources(path);
    const bool is_tiff = lower_ending(slices.front()).starts_with(".tif");
    return is_tiff ? read_tiff_slices(path, slices, memory_limit) : read_image_slices(path, slices, memory_limit);
  }
  const std::string ending = lower_ending(path);
  if (ending == ".nrrd" || ending == ".nhdr") return read_nrrd(path, memory_limit);
  if (ending == ".raw") return read_raw_stack(path, memory_limit);
  if (ending == ".tif" || ending == ".tiff") return read_tiff_stack(path, memory_limit);
  refuse_file(path, "", "'" + ending + "' is no stack format read here",
              "save the stack as multi-page TIFF, NRRD, RAW with a JSON sidecar, or a folder of TIFF or PNG slices");
}

void set_voxel_size(const std::filesystem::path& path, VoxelGrid& grid, const StackReading& reading) {
  const bool file_has_it = grid.spacing[0] > 0 && grid.spacing[1] > 0 && grid.spacing[2] > 0;
  if (!reading.voxel_size) {
    if (!file_has_it)
      refuse_file(path, "", "the file states no voxel size and none is guessed", "state it, such as --voxel '12 um'");
    return;
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (file_has_it && std::abs((*reading.voxel_size)[i] / grid.spacing[i] - 1) > kVoxelTolerance)
      refuse_file(path, "",
                  "states a voxel of " + size_text(grid.spacing) + ", --voxel one of " + size_text(*reading.voxel_size),
                  "leave --voxel out, or correct the file");
  if (!file_has_it) grid.spacing = *reading.voxel_size;
}

/// From the least to the greatest, without few voxels far beyond all others, such as those of a splinter of metal.
std::pair<double, double> grey_range(const std::vector<float>& values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  std::vector<float> sample;
  const std::size_t stride = values.size() / kQuantileSample + 1;
  for (std::size_t i = 0; i < values.size(); i += stride) sample.push_back(values[i]);
  const auto quantile = [&](double share) {
    const auto place = sample.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size() - 1));
    std::nth_element(sample.begin(), place, sample.end());
    return static_cast<double>(*place);
  };
  const double low = quantile(1e-4), high = quantile(1 - 1e-4), margin = (high - low) / 4;
  if (!(high > low)) return {*least, *greatest};
  return {std::max<double>(*least, low - margin), std::min<double>(*greatest, high + margin)};
}

}  // namespace

GreyVolume read_stack(const std::filesystem::path& path, const StackReading& reading) {
  GreyVolume volume = read_by_kind(path, reading.memory_limit);
  set_voxel_size(path, volume.grid, reading);
  return volume;
}

SampleSink::SampleSink(const std::filesystem::path& path, const std::array<int, 3>& size, const SampleType& type,
                       double memory_limit)
    : path_(path), type_(type) {
  const std::string extent =
      std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]) + " voxels";
  for (const int side : size)
    if (side < 3)
      refuse_file(path, "", "holds " + extent + ": no volume",
                  "give a stack of at least 3 slices of 3 x 3 pixels; a stack in one file is a multi-page TIFF");
  const double voxels = static_cast<double>(size[0]) * size[1] * size[2];
  if (voxels > kMostVoxels)
    refuse_file(path, "", "holds " + extent + ", more than 4e9", "crop the stack or halve its resolution");
  const int bytes = std::min(type.bytes, 2) + 5;  // real numbers are there before the labels are
  const double limit = memory_limit > 0 ? memory_limit
                                        : 0.9 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                                              static_cast<double>(sysconf(_SC_PAGESIZE));
  if (voxels * bytes > limit) {
    char text[120];
    std::snprintf(text, sizeof text, ": that needs %.1f GB of memory (%d bytes a voxel), %.1f GB may be used",
                  voxels * bytes / 1e9, bytes, limit / 1e9);
    refuse_file(path, "", "holds " + extent + text, "crop the stack, halve its resolution or take a larger machine");
  }
  volume_.grid.size = size;
  volume_.offset = !type.is_signed || type.is_real ? 0 : type.bytes == 1 ? -128 : -32768;
  if (type.is_real)
    reals_.resize(volume_.grid.count());
  else if (type.bytes == 1)
    volume_.values = std::vector<std::uint8_t>(volume_.grid.count());
  else
    volume_.values = std::vector<std::uint16_t>(volume_.grid.count());
}

void SampleSink::store_real(std::size_t first, std::string_view bytes) {
  const bool is_foreign = type_.is_big_endian == (std::endian::native == std::endian::little);
  for (std::size_t i = 0; 4 * i + 3 < bytes.size(); ++i) {
    std::array<char, 4> raw{};
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, raw.begin());
    if (is_foreign) std::reverse(raw.begin(), raw.end());
    reals_[first + i] = std::bit_cast<float>(raw);
  }
}

void SampleSink::store(std::size_t first, std::string_view bytes) {
  if (type_.is_real) return store_real(first, bytes);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[i])); };
  if (auto* const small = std::get_if<std::vector<std::uint8_t>>(&volume_.values)) {
    for (std::size_t i = 0; i < bytes.size(); ++i)
      (*small)[first + i] = static_cast<std::uint8_t>(byte(i) ^ (type_.is_signed ? 0x80u : 0u));
    return;
  }
  auto& large = std::get<std::vector<std::uint16_t>>(volume_.values);
  const std::size_t low = type_.is_big_endian ? 1 : 0;
  for (std::size_t i = 0; 2 * i + 1 < bytes.size(); ++i)
    large[first + i] =
        static_cast<std::uint16_t>((byte(2 * i + low) | byte(2 * i + 1 - low) << 8) ^ (type_.is_signed ? 0x8000u : 0u));
}

void SampleSink::store_file(const std::filesystem::path& path, std::size_t offset) {
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(offset));
  std::string slice(grid().index(0, 0, 1) * static_cast<std::size_t>(type_.bytes), '\0');
  for (int z = 0; z < grid().size[2]; ++z) {
    if (!stream.read(slice.data(), static_cast<std::streamsize>(slice.size())))
      refuse_file(path, "slice " + std::to_string(z + 1), "cannot be read: the file is cut off",
                  "export or copy the stack again");
    store(grid().index(0, 0, z), slice);
  }
}

GreyVolume SampleSink::finished() {
  if (!type_.is_real) return std::move(volume_);
  const auto bad = std::count_if(reals_.begin(), reals_.end(), [](float value) { return !std::isfinite(value); });
  if (bad > 0)
    refuse_file(path_, "", std::to_string(bad) + " voxels are no numbers (NaN or infinite)",
                "give them the grey value of what is around the grains");
  const auto [least, greatest] = grey_range(reals_);
  const double steps = std::numeric_limits<std::uint16_t>::max();
  if (greatest > least) volume_.step = (greatest - least) / steps;
  volume_.offset = least;
  std::vector<std::uint16_t> values;
  values.reserve(reals_.size());
  for (const float value : reals_)
    values.push_back(static_cast<std::uint16_t>(
        std::lround(std::clamp((static_cast<double>(value) - least) / volume_.step, 0.0, steps))));
  reals_ = {};
  volume_.values = std::move(values);
  return std::move(volume_);
}

double metres_of_unit(std::string_view unit) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"m", 1},         {"cm", 1e-2},      {"mm", 1e-3},         {"um", 1e-6},        {"nm", 1e-9},
      {"micron", 1e-6}, {"microns", 1e-6}, {"micrometer", 1e-6}, {"\xC2\xB5m", 1e-6}, {"\xB5m", 1e-6},
      {"inch", 0.0254}, {"in", 0.0254},    {"millimeter", 1e-3}, {"\\u00B5m", 1e-6},  {"nanometer", 1e-9}};
  for (const auto& [name, metres] : kUnits)
    if (unit == name) return metres;
  return 0;
}

}  // namespace shape_pipeline
