// SPDX-License-Identifier: Apache-2.0
#include "workflows/stl_file.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <string>

#include "catalog/input_error.h"
#include "workflows/atomic_file.h"

namespace workflows {
namespace {

using catalog::InputError;
using catalog::Point;
using catalog::TriangleMesh;

constexpr std::size_t kHeader = 84;    // 80 bytes of text, number of triangles
constexpr std::size_t kTriangle = 50;  // normal, three corners, 2 bytes of attributes
static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

class Welder {
 public:
  Welder(const std::filesystem::path& path, double metres_per_unit) : path_(path), scale_(metres_per_unit) {}

  void add_corner(const Point& corner) {
    for (const double x : corner)
      if (!std::isfinite(x))
        throw InputError(path_.string() + ": triangle " + std::to_string(mesh_.faces.size()) +
                         " has a coordinate that is no finite number");
    const Point scaled{scale_ * corner[0], scale_ * corner[1], scale_ * corner[2]};
    const auto [found, is_new] = index_.try_emplace(scaled, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(scaled);
    face_[static_cast<std::size_t>(corners_++)] = found->second;
    if (corners_ < 3) return;
    corners_ = 0;
    mesh_.faces.push_back(face_);
  }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  const std::filesystem::path& path_;
  double scale_;
  TriangleMesh mesh_;
  std::map<Point, int> index_;
  catalog::Triangle face_{};
  int corners_ = 0;
};

/// 0 if the bytes cannot be a binary STL.
std::size_t binary_triangles(const std::string& bytes) {
  if (bytes.size() < kHeader) return 0;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return bytes.size() == kHeader + kTriangle * count ? count : 0;
}

void read_binary(const std::string& bytes, std::size_t triangles, Welder& welder) {
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<float, 3> corner{};
      std::memcpy(corner.data(), bytes.data() + kHeader + kTriangle * t + 12 * (c + 1), sizeof corner);
      welder.add_corner({corner[0], corner[1], corner[2]});
    }
}

void read_text(const std::filesystem::path& path, const std::string& bytes, Welder& welder) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(path.string() + ": " + what + "; expected an STL file, text or binary, whole");
  };
  std::istringstream words(bytes);
  std::string word;
  int corners = 0;
  bool has_ended = false;
  while (words >> word) {
    if (word == "endsolid") has_ended = true;
    if (word == "vertex") {
      Point corner;
      if (!(words >> corner[0] >> corner[1] >> corner[2])) refuse("a vertex without three numbers");
      welder.add_corner(corner);
      ++corners;
    } else if (word == "endfacet") {
      if (corners != 3) refuse("a facet of " + std::to_string(corners) + " vertices");
      corners = 0;
    }
  }
  if (!has_ended || corners != 0) refuse("the text ends before endsolid");
}

}  // namespace

TriangleMesh read_stl(const std::filesystem::path& path, double metres_per_unit) {
  const std::optional<std::string> bytes = read_whole(path);
  if (!bytes) throw InputError(path.string() + ": cannot be read; expected an STL file");
  Welder welder(path, metres_per_unit);
  if (const std::size_t triangles = binary_triangles(*bytes)) {
    read_binary(*bytes, triangles, welder);
  } else if (bytes->starts_with("solid")) {
    read_text(path, *bytes, welder);
  } else {
    throw InputError(path.string() +
                     ": neither text that begins with 'solid' nor binary of the length that its number of triangles "
                     "asks for; expected an STL file, whole");
  }
  TriangleMesh mesh = welder.take();
  if (mesh.faces.empty()) throw InputError(path.string() + ": holds no triangles");
  return mesh;
}

}  // namespace workflows
