// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/io/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "catalog/input_error.h"
#include "dem_gpu/io/disk_sync.h"

namespace dem_gpu::io {
namespace {

// Rows of one chunk hold about this much: large enough to compress well, small enough for HDF5's chunk cache [bytes].
constexpr std::size_t kChunkBytes = 512 * 1024;
// zlib level: beyond 4 floating-point columns shrink by under 2 % for twice the time.
constexpr unsigned kDeflateLevel = 4;

/// Owns one HDF5 identifier.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Id() { reset(); }
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Id(const Id&) = delete;
  Id& operator=(Id&& other) noexcept {
    reset();
    id_ = std::exchange(other.id_, -1);
    close_ = other.close_;
    return *this;
  }

  operator hid_t() const { return id_; }
  bool is_valid() const { return id_ >= 0; }
  /// False if HDF5 could not close it, which for a file means that data did not reach the disk.
  bool reset() {
    const hid_t id = std::exchange(id_, -1);
    return id < 0 || close_(id) >= 0;
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Id property_list(hid_t cls) { return {H5Pcreate(cls), H5Pclose}; }

/// Stops HDF5 from printing its own error stack: each failure becomes one exception here.
void silence_error_stack() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

template <class T>
struct ElementType;
template <>
struct ElementType<double> {
  static hid_t memory() { return H5T_NATIVE_DOUBLE; }
  static hid_t file() { return H5T_IEEE_F64LE; }
  static constexpr const char* name = "64-bit floating point";
};
template <>
struct ElementType<float> {
  static hid_t memory() { return H5T_NATIVE_FLOAT; }
  static hid_t file() { return H5T_IEEE_F32LE; }
  static constexpr const char* name = "32-bit floating point";
};
template <>
struct ElementType<std::int32_t> {
  static hid_t memory() { return H5T_NATIVE_INT32; }
  static hid_t file() { return H5T_STD_I32LE; }
  static constexpr const char* name = "32-bit integers";
};
template <>
struct ElementType<std::int64_t> {
  static hid_t memory() { return H5T_NATIVE_INT64; }
  static hid_t file() { return H5T_STD_I64LE; }
  static constexpr const char* name = "64-bit integers";
};
template <>
struct ElementType<std::uint8_t> {
  static hid_t memory() { return H5T_NATIVE_UINT8; }
  static hid_t file() { return H5T_STD_U8LE; }
  static constexpr const char* name = "bytes";
};

/// Null-padded strings of one width.
Id string_type(std::size_t width) {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(width, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Id dataset_creation(std::size_t rows, std::size_t columns, std::size_t element_size) {
  Id properties = property_list(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(properties, false);
  if (rows == 0 || columns == 0) return properties;
  const std::size_t chunk_rows = std::clamp<std::size_t>(kChunkBytes / (columns * element_size), 1, rows);
  const hsize_t chunk[2] = {chunk_rows, columns};
  H5Pset_chunk(properties, 2, chunk);
  H5Pset_shuffle(properties);
  H5Pset_deflate(properties, kDeflateLevel);
  H5Pset_fletcher32(properties);
  return properties;
}

}  // namespace

struct Hdf5Writer::Handle {
  std::filesystem::path file;
  std::filesystem::path temporary;
  Id id{-1, H5Fclose};
  bool is_committed = false;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(file.string() + ": " + what + "; is the disk full or the folder read-only?");
  }
  void check(herr_t status, const std::string& place) const {
    if (status < 0) fail("cannot write " + place);
  }

  /// Makes the groups of "a/b/name" that are not there. HDF5 would make them itself, but stamps those with the time.
  void make_groups(const std::string& name) const {
    const Id creation = property_list(H5P_GROUP_CREATE);
    H5Pset_obj_track_times(creation, false);
    for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1)) {
      const std::string path = name.substr(0, end);
      if (H5Lexists(id, path.c_str(), H5P_DEFAULT) > 0) continue;
      const Id group(H5Gcreate2(id, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
      if (!group.is_valid()) fail("cannot create group " + path);
    }
  }

  void write_dataset(const std::string& name, hid_t memory_type, hid_t file_type, ArrayShape shape,
                     const void* values) const {
    const hsize_t extent[2] = {shape.rows, shape.columns};
    const Id space(H5Screate_simple(2, extent, nullptr), H5Sclose);
    const Id creation = dataset_creation(shape.rows, shape.columns, H5Tget_size(file_type));
    make_groups(name);
    const Id dataset(H5Dcreate2(id, name.c_str(), file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
    if (!dataset.is_valid()) fail("cannot create dataset " + name);
    if (shape.rows * shape.columns > 0)
      check(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  }

  void write_scalar(const std::string& name, hid_t memory_type, hid_t file_type, const void* value) const {
    const Id space(H5Screate(H5S_SCALAR), H5Sclose);
    const Id attribute(H5Acreate2(id, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!attribute.is_valid()) fail("cannot create attribute " + name);
    check(H5Awrite(attribute, memory_type, value), name);
  }
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file, const std::string& kind, int version)
    : handle_(std::make_unique<Handle>()) {
  silence_error_stack();
  handle_->file = file;
  handle_->temporary = file.string() + ".part";
  const Id creation = property_list(H5P_FILE_CREATE);
  H5Pset_obj_track_times(creation, false);
  const Id access = property_list(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);  // checksummed metadata
  handle_->id = Id(H5Fcreate(handle_->temporary.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  if (!handle_->id.is_valid()) handle_->fail("cannot create the file");
  write_attribute("kind", kind);
  write_attribute("version", static_cast<std::int64_t>(version));
}

Hdf5Writer::~Hdf5Writer() {
  if (handle_->is_committed) return;
  handle_->id.reset();
  std::error_code ignored;
  std::filesystem::remove(handle_->temporary, ignored);
}

template <class T>
void Hdf5Writer::write(const std::string& dataset, std::span<const T> values, std::size_t columns) {
  if (columns == 0 || values.size() % columns != 0)
    throw std::logic_error(dataset + ": " + std::to_string(values.size()) + " values do not fill rows of " +
                           std::to_string(columns));
  handle_->write_dataset(dataset, ElementType<T>::memory(), ElementType<T>::file(), {values.size() / columns, columns},
                         values.data());
}

template void Hdf5Writer::write<double>(const std::string&, std::span<const double>, std::size_t);
template void Hdf5Writer::write<float>(const std::string&, std::span<const float>, std::size_t);
template void Hdf5Writer::write<std::int32_t>(const std::string&, std::span<const std::int32_t>, std::size_t);
template void Hdf5Writer::write<std::int64_t>(const std::string&, std::span<const std::int64_t>, std::size_t);
template void Hdf5Writer::write<std::uint8_t>(const std::string&, std::span<const std::uint8_t>, std::size_t);

void Hdf5Writer::write_strings(const std::string& dataset, const std::vector<std::string>& values) {
  std::size_t width = 1;
  for (const std::string& value : values) width = std::max(width, value.size());
  std::vector<char> padded(values.size() * width, '\0');
  for (std::size_t row = 0; row < values.size(); ++row)
    std::copy(values[row].begin(), values[row].end(), padded.begin() + static_cast<std::ptrdiff_t>(row * width));
  const Id type = string_type(width);
  handle_->write_dataset(dataset, type, type, {values.size(), 1}, padded.data());
}

void Hdf5Writer::write_attribute(const std::string& name, const std::string& value) {
  std::string padded = value;
  if (padded.empty()) padded.push_back('\0');
  const Id type = string_type(padded.size());
  handle_->write_scalar(name, type, type, padded.data());
}

void Hdf5Writer::write_attribute(const std::string& name, double value) {
  handle_->write_scalar(name, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, &value);
}

void Hdf5Writer::write_attribute(const std::string& name, std::int64_t value) {
  handle_->write_scalar(name, H5T_NATIVE_INT64, H5T_STD_I64LE, &value);
}

void Hdf5Writer::commit() {
  if (!handle_->id.reset()) handle_->fail("cannot flush the file");
  if (!sync_to_disk(handle_->temporary)) handle_->fail(std::string("cannot flush the file: ") + std::strerror(errno));
  std::error_code error;
  std::filesystem::rename(handle_->temporary, handle_->file, error);
  if (error) handle_->fail("cannot rename the finished file: " + error.message());
  handle_->is_committed = true;
  // The rename itself; some file systems do not sync folders, and the file is whole either way.
  sync_to_disk(handle_->file.has_parent_path() ? handle_->file.parent_path() : std::filesystem::path("."));
}

struct Hdf5Reader::Handle {
  std::filesystem::path file;
  std::string kind;
  int version = 0;
  Id id{-1, H5Fclose};

  [[noreturn]] void refuse(const std::string& place, const std::string& what) const {
    throw catalog::InputError(file.string() + ": " + (place.empty() ? "" : place + ": ") + what);
  }

  bool has_path(const std::string& path) const {
    for (std::size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
      if (slash > 0 && H5Lexists(id, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    return H5Lexists(id, path.c_str(), H5P_DEFAULT) > 0;
  }

  Id open_dataset(const std::string& name) const {
    if (!has_path(name)) refuse("dataset " + name, "missing from this " + kind + " file; write it again");
    Id dataset(H5Dopen2(id, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.is_valid()) refuse("dataset " + name, "cannot be opened; the file is damaged");
    return dataset;
  }

  ArrayShape shape(const std::string& name, hid_t dataset) const {
    const Id space(H5Dget_space(dataset), H5Sclose);
    hsize_t extent[2] = {0, 0};
    if (H5Sget_simple_extent_ndims(space) != 2 || H5Sget_simple_extent_dims(space, extent, nullptr) != 2)
      refuse("dataset " + name, "expected an array of rows and columns");
    return {extent[0], extent[1]};
  }

  Id open_attribute(const std::string& name) const {
    if (H5Aexists(id, name.c_str()) <= 0) refuse("attribute " + name, "missing from this " + kind + " file");
    Id attribute(H5Aopen(id, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (!attribute.is_valid()) refuse("attribute " + name, "cannot be opened; the file is damaged");
    return attribute;
  }

  template <class T>
  T scalar_attribute(const std::string& name) const {
    const Id attribute = open_attribute(name);
    const Id type(H5Aget_type(attribute), H5Tclose);
    const Id space(H5Aget_space(attribute), H5Sclose);
    if (H5Tequal(type, ElementType<T>::file()) <= 0 || H5Sget_simple_extent_npoints(space) != 1)
      refuse("attribute " + name, std::string("expected one value of ") + ElementType<T>::name);
    T value{};
    if (H5Aread(attribute, ElementType<T>::memory(), &value) < 0)
      refuse("attribute " + name, "cannot be read; the file is damaged");
    return value;
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file, const std::string& kind, int newest_version)
    : handle_(std::make_unique<Handle>()) {
  silence_error_stack();
  handle_->file = file;
  handle_->kind = kind;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    handle_->refuse("", std::string(std::filesystem::exists(file, error) ? "is no file" : "no such file") +
                            "; expected a Talus " + kind + " file");
  const Id access = property_list(H5P_FILE_ACCESS);
  H5Pset_file_locking(access, false, true);  // files are renamed into place whole, so readers need no lock
  handle_->id = Id(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!handle_->id.is_valid())
    handle_->refuse("",
                    std::string(H5Fis_hdf5(file.c_str()) > 0 ? "truncated or damaged HDF5 file" : "not an HDF5 file") +
                        "; expected a Talus " + kind + " file: run the step that writes it again");
  if (!has_attribute("kind") || !has_attribute("version"))
    handle_->refuse("", "an HDF5 file, but not one of Talus; expected a Talus " + kind + " file");
  if (const std::string found = string_attribute("kind"); found != kind)
    handle_->refuse("", "a Talus " + found + " file; expected a " + kind + " file");
  const std::int64_t version = integer_attribute("version");
  if (version > newest_version)
    handle_->refuse("", kind + " version " + std::to_string(version) + ", this program reads up to " +
                            std::to_string(newest_version) + "; use a newer Talus");
  if (version < 1) handle_->refuse("attribute version", "expected 1 or more, found " + std::to_string(version));
  handle_->version = static_cast<int>(version);
}

Hdf5Reader::~Hdf5Reader() = default;

int Hdf5Reader::version() const { return handle_->version; }

bool Hdf5Reader::has(const std::string& dataset) const { return handle_->has_path(dataset); }

ArrayShape Hdf5Reader::shape(const std::string& dataset) const {
  return handle_->shape(dataset, handle_->open_dataset(dataset));
}

template <class T>
std::vector<T> Hdf5Reader::read(const std::string& name, std::size_t columns) const {
  const Id dataset = handle_->open_dataset(name);
  const ArrayShape shape = handle_->shape(name, dataset);
  if (shape.columns != columns)
    refuse("dataset " + name,
           "expected " + std::to_string(columns) + " columns, found " + std::to_string(shape.columns));
  const Id type(H5Dget_type(dataset), H5Tclose);
  if (H5Tequal(type, ElementType<T>::file()) <= 0)
    refuse("dataset " + name, std::string("expected ") + ElementType<T>::name);
  std::vector<T> values(shape.rows * shape.columns);
  if (!values.empty() && H5Dread(dataset, ElementType<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    refuse("dataset " + name, "cannot be read; the file is truncated or damaged");
  return values;
}

template <class T>
std::vector<T> Hdf5Reader::read(const std::string& dataset, const ArrayShape& expected) const {
  const ArrayShape found = shape(dataset);
  if (found.rows != expected.rows)
    refuse("dataset " + dataset,
           "expected " + std::to_string(expected.rows) + " rows, found " + std::to_string(found.rows));
  return read<T>(dataset, expected.columns);
}

template std::vector<double> Hdf5Reader::read<double>(const std::string&, std::size_t) const;
template std::vector<float> Hdf5Reader::read<float>(const std::string&, std::size_t) const;
template std::vector<std::int32_t> Hdf5Reader::read<std::int32_t>(const std::string&, std::size_t) const;
template std::vector<std::int64_t> Hdf5Reader::read<std::int64_t>(const std::string&, std::size_t) const;
template std::vector<std::uint8_t> Hdf5Reader::read<std::uint8_t>(const std::string&, std::size_t) const;
template std::vector<double> Hdf5Reader::read<double>(const std::string&, const ArrayShape&) const;
template std::vector<float> Hdf5Reader::read<float>(const std::string&, const ArrayShape&) const;
template std::vector<std::int32_t> Hdf5Reader::read<std::int32_t>(const std::string&, const ArrayShape&) const;
template std::vector<std::int64_t> Hdf5Reader::read<std::int64_t>(const std::string&, const ArrayShape&) const;
template std::vector<std::uint8_t> Hdf5Reader::read<std::uint8_t>(const std::string&, const ArrayShape&) const;

std::vector<std::string> Hdf5Reader::read_strings(const std::string& name) const {
  const Id dataset = handle_->open_dataset(name);
  const ArrayShape shape = handle_->shape(name, dataset);
  const Id type(H5Dget_type(dataset), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || shape.columns != 1)
    refuse("dataset " + name, "expected one column of strings");
  const std::size_t width = H5Tget_size(type);
  std::vector<char> padded(shape.rows * width);
  if (!padded.empty() && H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0)
    refuse("dataset " + name, "cannot be read; the file is truncated or damaged");
  std::vector<std::string> values;
  values.reserve(shape.rows);
  for (std::size_t row = 0; row < shape.rows; ++row) {
    const char* text = padded.data() + row * width;
    values.emplace_back(text, strnlen(text, width));
  }
  return values;
}

bool Hdf5Reader::has_attribute(const std::string& name) const { return H5Aexists(handle_->id, name.c_str()) > 0; }

std::string Hdf5Reader::string_attribute(const std::string& name) const {
  const Id attribute = handle_->open_attribute(name);
  const Id type(H5Aget_type(attribute), H5Tclose);
  const Id space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || H5Sget_simple_extent_npoints(space) != 1)
    refuse("attribute " + name, "expected a string");
  std::string value(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, value.data()) < 0) refuse("attribute " + name, "cannot be read; the file is damaged");
  value.resize(strnlen(value.data(), value.size()));
  return value;
}

double Hdf5Reader::double_attribute(const std::string& name) const { return handle_->scalar_attribute<double>(name); }

std::int64_t Hdf5Reader::integer_attribute(const std::string& name) const {
  return handle_->scalar_attribute<std::int64_t>(name);
}

void Hdf5Reader::refuse(const std::string& place, const std::string& what) const { handle_->refuse(place, what); }

}  // namespace dem_gpu::io
