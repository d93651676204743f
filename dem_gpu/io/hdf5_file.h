// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dem_gpu::io {

// HDF5 files of n x k arrays with a kind and a version, written beside and renamed. Nothing that changes from run to
// run (object times, addresses of a heap) goes in, so equal contents give equal bytes. Array data carry checksums.
// Element types: double, float, std::int32_t, std::int64_t, std::uint8_t.

/// Rows and columns of an array.
struct ArrayShape {
  std::size_t rows = 0;
  std::size_t columns = 1;
  friend bool operator==(const ArrayShape&, const ArrayShape&) = default;
};

/// Writes one file; until commit() returns, an earlier file of that name stays as it was.
/// Each function throws std::runtime_error naming the file if the disk does not take the data.
class Hdf5Writer {
 public:
  /// Creates `file`.part with the attributes kind and version.
  Hdf5Writer(const std::filesystem::path& file, const std::string& kind, int version);
  /// Removes the temporary file if commit() was not called.
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// `values` row by row, size a multiple of `columns`; groups on the dataset path ("bodies/position") are made.
  template <class T>
  void write(const std::string& dataset, std::span<const T> values, std::size_t columns = 1);
  template <class T>
  void write(const std::string& dataset, const std::vector<T>& values, std::size_t columns = 1) {
    write(dataset, std::span<const T>(values), columns);
  }
  /// One string a row, without embedded zeros.
  void write_strings(const std::string& dataset, const std::vector<std::string>& values);

  // Attributes of the file.
  void write_attribute(const std::string& name, const std::string& value);
  void write_attribute(const std::string& name, double value);
  void write_attribute(const std::string& name, std::int64_t value);

  /// Flushes to the disk and renames. Nothing may be written afterwards.
  void commit();

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// Reads a file that Hdf5Writer wrote. Every function throws catalog::InputError, one line naming file and place, if
/// the file is missing, truncated, damaged, of another kind, or lacks what is asked for in the type asked for.
class Hdf5Reader {
 public:
  /// `newest_version`: the highest version of `kind` that the caller understands.
  Hdf5Reader(const std::filesystem::path& file, const std::string& kind, int newest_version);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  int version() const;

  /// True if there is a dataset of that path.
  bool has(const std::string& dataset) const;
  ArrayShape shape(const std::string& dataset) const;

  /// Row by row. The array must have that many columns.
  template <class T>
  std::vector<T> read(const std::string& dataset, std::size_t columns = 1) const;
  /// As above; the array must have exactly `shape`.
  template <class T>
  std::vector<T> read(const std::string& dataset, const ArrayShape& shape) const;
  std::vector<std::string> read_strings(const std::string& dataset) const;

  bool has_attribute(const std::string& name) const;
  std::string string_attribute(const std::string& name) const;
  double double_attribute(const std::string& name) const;
  std::int64_t integer_attribute(const std::string& name) const;

  /// Throws catalog::InputError "FILE: PLACE: WHAT": for what the caller finds wrong in the contents.
  [[noreturn]] void refuse(const std::string& place, const std::string& what) const;

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace dem_gpu::io
