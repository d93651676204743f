// SPDX-License-Identifier: Apache-2.0
#include "workflows/mesh_export.h"

#include <fcntl.h>
#include <unistd.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "catalog/input_error.h"

namespace workflows {
namespace {

using catalog::Point;
using catalog::Triangle;

static_assert(std::endian::native == std::endian::little, "binary STL and PLY are written as numbers lie in memory");

template <class Value>
void append(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Shortest text that reads back as the same double.
std::string text_of(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

Point unit_normal(const catalog::TriangleMesh& mesh, const Triangle& face) {
  const Point &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]], &c = mesh.vertices[face[2]];
  Point normal;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    normal[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
  }
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (length > 0)
    for (double& component : normal) component /= length;
  return normal;  // (0, 0, 0) for a face without area, which readers work out themselves
}

}  // namespace

ExportMesh joined(const std::vector<catalog::ConvexPart>& parts) {
  ExportMesh shape;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const int first = static_cast<int>(shape.mesh.vertex_count());
    const catalog::TriangleMesh piece = triangulated(parts[p]);
    shape.mesh.vertices.insert(shape.mesh.vertices.end(), piece.vertices.begin(), piece.vertices.end());
    for (const Triangle& face : piece.faces) {
      shape.mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
      shape.part.push_back(static_cast<int>(p));
    }
  }
  return shape;
}

std::string stl_bytes(const ExportMesh& shape) {
  std::string bytes = "binary STL by talus, coordinates in metres";  // must not begin with "solid"
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(shape.mesh.face_count()));
  for (const Triangle& face : shape.mesh.faces) {
    for (const double component : unit_normal(shape.mesh, face)) append(bytes, static_cast<float>(component));
    for (const int vertex : face)
      for (const double coordinate : shape.mesh.vertices[vertex]) append(bytes, static_cast<float>(coordinate));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string ply_bytes(const ExportMesh& shape) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment written by talus, coordinates in metres\n";
  bytes += "element vertex " + std::to_string(shape.mesh.vertex_count()) + "\n";
  bytes += "property double x\nproperty double y\nproperty double z\n";
  bytes += "element face " + std::to_string(shape.mesh.face_count()) + "\n";
  bytes += "property list uchar int vertex_indices\n";
  if (!shape.part.empty()) bytes += "property int part\n";
  bytes += "end_header\n";
  for (const Point& vertex : shape.mesh.vertices)
    for (const double coordinate : vertex) append(bytes, coordinate);
  for (std::size_t f = 0; f < shape.mesh.face_count(); ++f) {
    append(bytes, std::uint8_t{3});
    for (const int vertex : shape.mesh.faces[f]) append(bytes, static_cast<std::int32_t>(vertex));
    if (!shape.part.empty()) append(bytes, static_cast<std::int32_t>(shape.part[f]));
  }
  return bytes;
}

std::string off_bytes(const ExportMesh& shape) {
  std::string bytes = "OFF\n# written by talus, coordinates in metres\n";
  bytes += std::to_string(shape.mesh.vertex_count()) + " " + std::to_string(shape.mesh.face_count()) + " 0\n";
  for (const Point& vertex : shape.mesh.vertices)
    bytes += text_of(vertex[0]) + " " + text_of(vertex[1]) + " " + text_of(vertex[2]) + "\n";
  for (const Triangle& face : shape.mesh.faces)
    bytes += "3 " + std::to_string(face[0]) + " " + std::to_string(face[1]) + " " + std::to_string(face[2]) + "\n";
  return bytes;
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  const std::string beside = path.string() + ".unfinished-" + std::to_string(getpid());
  const int file = open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0)
    throw catalog::InputError(path.string() +
                              ": cannot be written; expected a path in an existing folder with write "
                              "permission");
  std::size_t written = 0;
  ssize_t step = 0;
  while (written < bytes.size() && (step = write(file, bytes.data() + written, bytes.size() - written)) > 0)
    written += static_cast<std::size_t>(step);
  const bool is_flushed = written == bytes.size() && fsync(file) == 0;
  if (close(file) != 0 || !is_flushed) {
    unlink(beside.c_str());
    throw std::runtime_error(path.string() + ": writing failed, is the disk full? Nothing was changed");
  }
  if (rename(beside.c_str(), path.c_str()) != 0) {
    unlink(beside.c_str());
    throw catalog::InputError(path.string() + ": cannot be replaced; expected a file name, not a folder");
  }
}

}  // namespace workflows
