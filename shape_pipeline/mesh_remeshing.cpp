// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/mesh_remeshing.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/edge_collapse.h"
#include "shape_pipeline/meshes/isotropic_remeshing.h"
#include "shape_pipeline/meshes/self_intersections.h"

namespace shape_pipeline {
namespace {

constexpr double kLargestVolumeChange = 0.001;  // what a remeshing may cost unseen
constexpr double kLargestAreaChange = 0.01;     // rough surfaces lose area with detail

catalog::Check change_check(const char* quantity, double change, double limit) {
  char line[120];
  std::snprintf(line, sizeof line, "remeshing changed the %s by %.4f %%, expected at most %.1f %%", quantity,
                100 * change, 100 * limit);
  return {std::string("remeshing_") + quantity + "_change", std::abs(change) <= limit, change, line};
}

}  // namespace

RemeshedMesh remesh(const catalog::TriangleMesh& mesh, const RemeshingOptions& options) {
  if (options.style == RemeshingStyle::edge_collapse && mesh.faces.size() <= options.face_limit) return {mesh, {}};
  catalog::TriangleMesh result;
  if (options.style == RemeshingStyle::edge_collapse) {
    result = collapsed_to(mesh, options.face_limit);
  } else {
    // Edge of equilateral triangles that together have the mesh's area.
    const double face = surface_area(mesh) / static_cast<double>(options.face_limit);
    result = isotropic_remeshing(mesh, std::sqrt(4 * face / std::numbers::sqrt3));
  }
  const MeshTopology before = mesh_topology(mesh), after = mesh_topology(result);
  if (!after.is_closed() || after.euler_number != before.euler_number || result.faces.empty())
    return {mesh,
            {{"remeshed_faces", false, static_cast<double>(mesh.faces.size()),
              "remeshing would have opened the surface; the mesh is unchanged"}}};
  std::size_t cuts = count_self_intersections(result);
  if (cuts > 0) {
    const catalog::TriangleMesh recut = without_self_intersections(result);
    const MeshTopology then = mesh_topology(recut);
    const bool is_sound = then.is_closed() && then.euler_number == before.euler_number &&
                          std::abs(signed_volume(recut) / signed_volume(result) - 1) <= kLargestVolumeChange;
    if (is_sound && count_self_intersections(recut) < cuts) {
      result = recut;
      cuts = count_self_intersections(result);
    }
  }
  const double volume_change = signed_volume(result) / signed_volume(mesh) - 1;
  const double area_change = surface_area(result) / surface_area(mesh) - 1;
  return {std::move(result),
          {{"remeshed_faces", true, static_cast<double>(mesh.faces.size()), "faces before remeshing (figure)"},
           {"remeshing_self_intersections", cuts == 0, static_cast<double>(cuts),
            "pairs of faces that cut one another after remeshing, expected 0; more --faces keep thin walls apart"},
           change_check("volume", volume_change, kLargestVolumeChange),
           change_check("area", area_change, kLargestAreaChange)}};
}

}  // namespace shape_pipeline
