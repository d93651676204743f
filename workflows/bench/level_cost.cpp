// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/level_cost.h"

#include <cmath>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/laws/laws_cases.h"

namespace workflows {
dem_gpu::Shape unit_shape(const std::string& name, catalog::LevelOfDetail level) {
  const double size = std::cbrt(level.mass_properties.volume);
  for (catalog::ConvexPart& part : level.parts) {
    for (catalog::Point& vertex : part.vertices)
      for (double& x : vertex) x /= size;
    for (catalog::ConvexFace& face : part.faces) face.plane.offset /= size;
  }
  return dem_gpu::polyhedral_shape(name, level.parts);
}

double measured_contact_cost(const dem_gpu::Shape& body) {
  const dem_gpu::PolyhedralLaw law = dem_gpu::DepthPotential{1};
  const dem_gpu::Shape cube = box_shape({1, 1, 1});
  return time_per_pair(body, body, law) / time_per_pair(cube, cube, law);
}

std::string ladder_name(const catalog::LevelKey& key) {
  std::string name = std::to_string(key.vertex_cap);
  if (key.face_cap > 0) name += "-f" + std::to_string(key.face_cap);
  return key.mode == catalog::FitMode::volume_true ? name : name + "-" + mode_name(key.mode);
}

std::string ladder_text(const catalog::LevelKey& key) {
  std::string text = std::to_string(key.vertex_cap) + " vertices";
  if (key.face_cap > 0) text += ", " + std::to_string(key.face_cap) + " faces";
  return key.mode == catalog::FitMode::volume_true ? text : text + ", " + mode_name(key.mode);
}

}  // namespace workflows
