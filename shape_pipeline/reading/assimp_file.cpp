// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/reading/assimp_file.h"

#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <limits>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/reading/scan_bytes.h"

namespace shape_pipeline {
namespace {

constexpr double kLargestBlur = 1e-5;  // rounding of a coordinate / diagonal: a tenth of what a good scanner resolves

void refuse_blurred(const std::filesystem::path& path, const catalog::TriangleMesh& mesh) {
  double largest = 0;
  for (const catalog::Point& p : mesh.vertices)
    for (const double coordinate : p) largest = std::max(largest, std::abs(coordinate));
  const double blur = largest * std::numeric_limits<float>::epsilon();
  if (blur > kLargestBlur * bounding_diagonal(mesh.vertices))
    refuse_file(path, "vertices", "the mesh lies so far from its origin that single precision blurs it",
                "move it near the origin, or export it as PLY with type double");
}

}  // namespace

catalog::TriangleMesh read_with_assimp(const std::filesystem::path& path, std::string_view bytes,
                                       const std::string& format) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                     aiProcess_Triangulate | aiProcess_SortByPType, format.c_str());
  if (scene == nullptr)
    refuse_file(path, "", "assimp cannot read it: " + std::string(importer.GetErrorString()), "export the mesh again");
  catalog::TriangleMesh mesh;
  for (unsigned int m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    if ((part.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) continue;  // lines and points
    const int first = static_cast<int>(mesh.vertices.size());
    for (unsigned int v = 0; v < part.mNumVertices; ++v)
      mesh.vertices.push_back({part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z});
    for (unsigned int f = 0; f < part.mNumFaces; ++f) {
      const unsigned int* corner = part.mFaces[f].mIndices;
      // Assimp parts lines from triangles, but not in every broken file, and passes indices on.
      if (part.mFaces[f].mNumIndices != 3 ||
          std::any_of(corner, corner + 3, [&](unsigned int v) { return v >= part.mNumVertices; }))
        refuse_file(path, "face " + std::to_string(mesh.faces.size() + 1), "is no triangle of the mesh's vertices",
                    "export the mesh again");
      mesh.faces.push_back({first + static_cast<int>(corner[0]), first + static_cast<int>(corner[1]),
                            first + static_cast<int>(corner[2])});
    }
  }
  refuse_blurred(path, mesh);
  return mesh;
}

}  // namespace shape_pipeline
