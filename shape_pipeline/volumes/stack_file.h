// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "shape_pipeline/volumes/grey_volume.h"

namespace shape_pipeline {

/// How a file holds one grey value.
struct SampleType {
  int bytes = 1;  // 1 or 2
  bool is_signed = false;
  bool is_big_endian = false;  // of two bytes
};

struct StackReading {
  std::optional<std::array<double, 3>> voxel_size;  // stated beside the file [m]
  double memory_limit = 0;                          // [bytes]; 0: nine tenths of the machine's memory
};

/// Reads a multi-page TIFF, a folder of one-page TIFF slices (in natural order: 2 before 10), a NRRD (raw or gzip) or a
/// RAW with its JSON sidecar. Grey values of 8 or 16 bits, signed or not. Throws InputError, naming file, cause and
/// remedy, for what is none of these, and where the voxel size is missing or the file and the reading state two.
GreyVolume read_stack(const std::filesystem::path& path, const StackReading& reading);

/// For readers: an empty volume, after a check that the whole way of the stack fits into memory: the grey values, four
/// bytes a voxel for distances and labels, and up to one more for the front of the flood.
GreyVolume new_volume(const std::filesystem::path& path, const std::array<int, 3>& size, const SampleType& type,
                      double memory_limit);

/// For readers: grey values of a file into the voxels from `first` on.
void store_samples(GreyVolume& volume, std::size_t first, std::string_view bytes, const SampleType& type);

/// For readers: fills the volume with the bytes of a file from `offset` on. Throws InputError where they end before.
void read_samples(const std::filesystem::path& path, std::size_t offset, GreyVolume& volume, const SampleType& type);

/// For readers: the metres of a unit as image files spell it ("mm", "um", "micron", ...); 0 if it is none.
double metres_of_unit(std::string_view unit);

GreyVolume read_tiff_stack(const std::filesystem::path& path, double memory_limit);    // spacing 0 where none is stated
GreyVolume read_slice_folder(const std::filesystem::path& path, double memory_limit);  // spacing 0
GreyVolume read_nrrd(const std::filesystem::path& path, double memory_limit);          // spacing 0 where none is stated
GreyVolume read_raw_stack(const std::filesystem::path& path, double memory_limit);     // spacing 0 where none is stated

}  // namespace shape_pipeline
