// SPDX-License-Identifier: GPL-3.0-or-later
// Every reader of scans against bytes of any kind: it reads them or throws InputError. A target of libFuzzer (`make
// fuzz`); reader_fuzz_driver.cpp runs it where the compiler has none.
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "catalog/input_error.h"
#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/micrographs/image_file.h"
#include "shape_pipeline/scan_file.h"
#include "shape_pipeline/silhouettes/turntable_camera.h"
#include "shape_pipeline/volumes/stack_file.h"

namespace {

namespace fs = std::filesystem;

constexpr double kMemoryLimit = 64e6;                  // of a stack [bytes]
constexpr std::string_view kTurntable = ".turntable";  // stands for turntable.json, since .json belongs to a RAW

/// A folder in memory, where there is one, that goes when the process ends.
class WorkFolder {
 public:
  WorkFolder() : path_(base() / ("talus-fuzz-" + std::to_string(getpid()))) { fs::create_directories(path_); }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  static fs::path base() { return fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path(); }
  fs::path path_;
};

void write(const fs::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void read_any(const fs::path& path) {
  const std::string ending = path.extension();
  if (ending == ".tif" || ending == ".nrrd" || ending == ".nhdr" || ending == ".raw") {
    shape_pipeline::read_stack(path, {std::array<double, 3>{1e-5, 1e-5, 1e-5}, kMemoryLimit});
  } else if (ending == ".png" || ending == ".jpg" || ending == ".bmp") {
    shape_pipeline::read_image(path);
  } else if (ending == kTurntable) {
    shape_pipeline::view_angles(shape_pipeline::read_turntable_camera(path), 12);
  } else if (shape_pipeline::scan_kind(path) == shape_pipeline::ScanKind::mesh) {
    shape_pipeline::read_mesh(path, 1);
  } else {
    shape_pipeline::read_cloud(path, {});
  }
}

}  // namespace

/// The first line is the file's ending, such as ".ply"; a RAW begins with its sidecar, up to a zero byte.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const WorkFolder folder;
  static constexpr std::string_view kEndings[] = {".ply",  ".pcd",  ".xyz", ".stl", ".obj", ".off", ".tab",    ".tif",
                                                  ".nrrd", ".nhdr", ".raw", ".png", ".jpg", ".bmp", kTurntable};
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t line = input.find('\n');
  if (line == std::string_view::npos) return 0;
  const std::string_view ending = input.substr(0, line);
  std::string_view bytes = input.substr(line + 1);
  if (std::find(std::begin(kEndings), std::end(kEndings), ending) == std::end(kEndings)) return 0;
  const fs::path file = folder.path() / ("scan" + std::string(ending));
  if (ending == ".raw") {
    const std::size_t end = std::min(bytes.find('\0'), bytes.size());
    write(folder.path() / "scan.json", bytes.substr(0, end));
    bytes = bytes.substr(std::min(end + 1, bytes.size()));
  }
  write(file, bytes);
  try {
    read_any(file);
  } catch (const catalog::InputError& error) {
    // The text is one line and names the file.
    const std::string_view text = error.what();
    if (text.find('\n') == std::string_view::npos && text.find("scan.") != std::string_view::npos) return 0;
    std::fprintf(stderr, "refused by more or less than a line that names the file: %s\n", error.what());
    std::abort();
  }
  return 0;
}
