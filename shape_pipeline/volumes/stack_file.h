// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "shape_pipeline/volumes/grey_volume.h"

namespace shape_pipeline {

/// How a file holds one grey value.
struct SampleType {
  int bytes = 1;  // 1 or 2, of real numbers 4
  bool is_signed = false;
  bool is_big_endian = false;  // of more than one byte
  bool is_real = false;        // IEEE single precision
};

struct StackReading {
  std::optional<std::array<double, 3>> voxel_size;  // stated beside the file [m]
  double memory_limit = 0;                          // [bytes]; 0: nine tenths of the machine's memory
};

/// Reads a multi-page TIFF, a folder of slices, one a file (TIFF, PNG, BMP or JPEG, in natural order: 2 before 10), a
/// NRRD (raw or gzip, attached or with its values in a file of their own) or a RAW with its JSON sidecar. Grey values
/// of 8 or 16 bits, signed or not, or real numbers of 32 bits, which become 65,536 steps. Throws InputError, naming
/// file, cause and remedy, for what is none of these, and where the voxel size is missing or the file and the reading
/// state two.
GreyVolume read_stack(const std::filesystem::path& path, const StackReading& reading);

/// For readers: takes the grey values of a file.
class SampleSink {
 public:
  /// Checks that the whole way of the stack fits into memory: the grey values, four bytes a voxel for distances and
  /// labels, and up to one more for the front of the flood.
  SampleSink(const std::filesystem::path& path, const std::array<int, 3>& size, const SampleType& type,
             double memory_limit);

  const VoxelGrid& grid() const { return volume_.grid; }
  const SampleType& type() const { return type_; }
  void set_spacing(const std::array<double, 3>& spacing) { volume_.grid.spacing = spacing; }  // [m]

  /// The voxels from `first` on.
  void store(std::size_t first, std::string_view bytes);

  /// The bytes of a file from `offset` on for all voxels. Throws InputError where they end before.
  void store_file(const std::filesystem::path& path, std::size_t offset);

  /// Once all is stored. Real numbers: steps from the least to the greatest, but that voxels beyond the 0.01 %
  /// and 99.99 % quantiles by more than a quarter of their distance are clipped. Throws InputError for numbers that are
  /// none.
  GreyVolume finished();

 private:
  void store_real(std::size_t first, std::string_view bytes);

  std::filesystem::path path_;
  SampleType type_;
  GreyVolume volume_;
  std::vector<float> reals_;  // until they are finished
};

/// For readers: the metres of a unit as image files spell it ("mm", "um", "micron", ...); 0 if it is none.
double metres_of_unit(std::string_view unit);

// Spacing 0 where none is stated; slices never state one.
GreyVolume read_tiff_stack(const std::filesystem::path& path, double memory_limit);
GreyVolume read_tiff_slices(const std::filesystem::path& path, const std::vector<std::filesystem::path>& slices,
                            double memory_limit);
GreyVolume read_image_slices(const std::filesystem::path& path, const std::vector<std::filesystem::path>& slices,
                             double memory_limit);
GreyVolume read_nrrd(const std::filesystem::path& path, double memory_limit);
GreyVolume read_raw_stack(const std::filesystem::path& path, double memory_limit);

/// The file that holds a NRRD's values: itself, or the one that its header names beside it.
std::filesystem::path nrrd_values_file(const std::filesystem::path& path);

}  // namespace shape_pipeline
