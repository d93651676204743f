// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/volumes/stack_file.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <utility>

#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/stack_sources.h"

namespace shape_pipeline {
namespace {

constexpr double kVoxelTolerance = 1e-3;  // relative: sizes are written with three digits at least
constexpr double kMostVoxels = 4e9;       // voxels are counted in 32 bits

std::string size_text(const std::array<double, 3>& size) {
  char text[100];
  std::snprintf(text, sizeof text, "%.5g x %.5g x %.5g um", size[0] * 1e6, size[1] * 1e6, size[2] * 1e6);
  return text;
}

GreyVolume read_by_kind(const std::filesystem::path& path, double memory_limit) {
  if (std::filesystem::is_directory(path)) return read_slice_folder(path, memory_limit);
  const std::string ending = lower_ending(path);
  if (ending == ".nrrd") return read_nrrd(path, memory_limit);
  if (ending == ".raw") return read_raw_stack(path, memory_limit);
  if (ending == ".tif" || ending == ".tiff") return read_tiff_stack(path, memory_limit);
  refuse_file(path, "", "'" + ending + "' is no stack format read here",
              "save the stack as multi-page TIFF, NRRD, RAW with a JSON sidecar, or a folder of TIFF slices");
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

}  // namespace

GreyVolume read_stack(const std::filesystem::path& path, const StackReading& reading) {
  GreyVolume volume = read_by_kind(path, reading.memory_limit);
  set_voxel_size(path, volume.grid, reading);
  return volume;
}

GreyVolume new_volume(const std::filesystem::path& path, const std::array<int, 3>& size, const SampleType& type,
                      double memory_limit) {
  const std::string extent =
      std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]) + " voxels";
  for (const int side : size)
    if (side < 3)
      refuse_file(path, "", "holds " + extent + ": no volume",
                  "give a stack of at least 3 slices of 3 x 3 pixels; a stack in one file is a multi-page TIFF");
  const double voxels = static_cast<double>(size[0]) * size[1] * size[2];
  if (voxels > kMostVoxels)
    refuse_file(path, "", "holds " + extent + ", more than 4e9", "crop the stack or halve its resolution");
  const double needed = voxels * (type.bytes + 5);
  const double limit = memory_limit > 0 ? memory_limit
                                        : 0.9 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                                              static_cast<double>(sysconf(_SC_PAGESIZE));
  if (needed > limit) {
    char text[120];
    std::snprintf(text, sizeof text, ": that needs %.1f GB of memory (%d bytes a voxel), %.1f GB may be used",
                  needed / 1e9, type.bytes + 5, limit / 1e9);
    refuse_file(path, "", "holds " + extent + text, "crop the stack, halve its resolution or take a larger machine");
  }
  GreyVolume volume;
  volume.grid.size = size;
  volume.offset = !type.is_signed ? 0 : type.bytes == 1 ? -128 : -32768;
  if (type.bytes == 1)
    volume.values = std::vector<std::uint8_t>(volume.grid.count());
  else
    volume.values = std::vector<std::uint16_t>(volume.grid.count());
  return volume;
}

void store_samples(GreyVolume& volume, std::size_t first, std::string_view bytes, const SampleType& type) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[i])); };
  if (auto* const small = std::get_if<std::vector<std::uint8_t>>(&volume.values)) {
    for (std::size_t i = 0; i < bytes.size(); ++i)
      (*small)[first + i] = static_cast<std::uint8_t>(byte(i) ^ (type.is_signed ? 0x80u : 0u));
    return;
  }
  auto& large = std::get<std::vector<std::uint16_t>>(volume.values);
  const std::size_t low = type.is_big_endian ? 1 : 0;
  for (std::size_t i = 0; 2 * i + 1 < bytes.size(); ++i)
    large[first + i] =
        static_cast<std::uint16_t>((byte(2 * i + low) | byte(2 * i + 1 - low) << 8) ^ (type.is_signed ? 0x8000u : 0u));
}

void read_samples(const std::filesystem::path& path, std::size_t offset, GreyVolume& volume, const SampleType& type) {
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(offset));
  std::string slice(volume.grid.index(0, 0, 1) * static_cast<std::size_t>(type.bytes), '\0');
  for (int z = 0; z < volume.grid.size[2]; ++z) {
    if (!stream.read(slice.data(), static_cast<std::streamsize>(slice.size())))
      refuse_file(path, "slice " + std::to_string(z + 1), "cannot be read: the file is cut off",
                  "export or copy the stack again");
    store_samples(volume, volume.grid.index(0, 0, z), slice, type);
  }
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
