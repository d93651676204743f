// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>

#include "shape_pipeline/reading/assimp_file.h"
#include "shape_pipeline/reading/mesh_file_checks.h"
#include "shape_pipeline/reading/ply_file.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/reading/scan_extent.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr char kExportAgain[] = "copy or export the mesh again";

catalog::TriangleMesh read_ply_mesh(const std::filesystem::path& path) {
  PlyContents contents = read_ply(path);
  catalog::TriangleMesh mesh;
  mesh.vertices = std::move(contents.points);
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  for (std::size_t f = 0; f < contents.faces.size(); ++f) {
    const std::vector<std::int64_t>& polygon = contents.faces[f];
    for (const std::int64_t v : polygon)
      if (v < 0 || v >= count)
        refuse_file(path, "face " + std::to_string(f + 1),
                    "vertex index " + std::to_string(v) + " is not in 0 to " + std::to_string(count - 1), kExportAgain);
    for (std::size_t c = 2; c < polygon.size(); ++c)
      mesh.faces.push_back(
          {static_cast<int>(polygon[0]), static_cast<int>(polygon[c - 1]), static_cast<int>(polygon[c])});
  }
  return mesh;
}

catalog::TriangleMesh read_shape_table(const std::filesystem::path& path, std::string_view bytes) {
  catalog::TriangleMesh mesh;
  TextRows rows(bytes);
  while (rows.next()) {
    const auto words = words_of(rows.row());
    double number[3] = {};
    bool is_good = words.size() == 4 && (words[0] == "v" || words[0] == "f");
    for (int w = 0; w < 3 && is_good; ++w) is_good = parse_number(words[w + 1], number[w]);
    if (!is_good)
      refuse_file(path, rows.place(), "expected 'v x y z' or 'f i j k', found " + excerpt(rows.row()),
                  "the file may be truncated or of another kind; copy it again");
    if (words[0] == "v") {
      mesh.vertices.push_back({number[0], number[1], number[2]});
      continue;
    }
    catalog::Triangle face;
    for (int c = 0; c < 3; ++c) {
      if (number[c] < 1 || number[c] > static_cast<double>(mesh.vertices.size()) || number[c] != std::floor(number[c]))
        refuse_file(path, rows.place(),
                    "expected vertex numbers from 1 to " + std::to_string(mesh.vertices.size()) + ", found " +
                        excerpt(rows.row()),
                    kExportAgain);
      face[c] = static_cast<int>(number[c]) - 1;
    }
    mesh.faces.push_back(face);
  }
  return mesh;
}

}  // namespace

catalog::TriangleMesh read_mesh(const std::filesystem::path& path, double metres_per_unit) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const ScanBytes file(path);
  const std::string_view bytes = file.view();
  catalog::TriangleMesh mesh;
  if (ending == ".ply") {
    mesh = read_ply_mesh(path);
  } else if (ending == ".tab") {
    mesh = read_shape_table(path, bytes);
  } else if (ending == ".stl") {
    check_stl(path, bytes);
    mesh = read_with_assimp(path, bytes, "stl");
  } else if (ending == ".obj") {
    check_obj(path, bytes);
    mesh = read_with_assimp(path, bytes, "obj");
  } else if (ending == ".off") {
    check_off(path, bytes);
    mesh = read_with_assimp(path, bytes, "off");
  } else {
    refuse_file(path, "", "'" + ending + "' is no mesh format read here", "save it as STL, OBJ, PLY or OFF");
  }
  if (mesh.faces.empty()) refuse_file(path, "", "the file holds no faces", kExportAgain);
  std::size_t bad = 0;
  for (const Point& p : mesh.vertices) bad += !std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]);
  if (bad > 0)
    refuse_file(path, "vertices",
                std::to_string(bad) + " of " + std::to_string(mesh.vertices.size()) +
                    " have a coordinate that is no number (NaN or infinite)",
                "clean the mesh and export it again");
  refuse_flat_scan(path, mesh.vertices);
  if (mesh.faces.size() < 4)
    refuse_file(path, "faces",
                "expected at least 4, as a closed surface has, found " + std::to_string(mesh.faces.size()),
                kExportAgain);
  for (Point& p : mesh.vertices) p = scaled(p, metres_per_unit);
  refuse_impossible_size(path, mesh.vertices);
  return mesh;
}

void write_stl(const std::filesystem::path& path, const catalog::TriangleMesh& mesh) {
  std::string bytes(80, ' ');
  const auto append = [&](const void* source, std::size_t size) {
    bytes.append(static_cast<const char*>(source), size);
  };
  const auto count = static_cast<std::uint32_t>(mesh.faces.size());
  append(&count, sizeof count);
  for (const catalog::Triangle& face : mesh.faces) {
    const Point& origin = mesh.vertices[face[0]];
    const Point normal =
        normalized(cross(subtract(mesh.vertices[face[1]], origin), subtract(mesh.vertices[face[2]], origin)));
    for (const Point& row : {normal, mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]})
      for (const double coordinate : row) {
        const auto single = static_cast<float>(coordinate);
        append(&single, sizeof single);
      }
    bytes.append(2, '\0');
  }
  std::filesystem::path beside = path;
  beside += ".part";
  {
    std::ofstream stream(beside, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream.flush()) refuse_file(path, "", "cannot be written", "check the folder and the space on the disk");
  }
  std::filesystem::rename(beside, path);
}

}  // namespace shape_pipeline
