// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/level_cost.h"

#include <cmath>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/laws/laws_cases.h"

namespace workflows {
namespace {

const dem_gpu::PolyhedralLaw kLaw = dem_gpu::DepthPotential{1};

/// The level at a volume of 1, so that the depths of the pairs are shares of the size.
dem_gpu::Shape unit_shape(catalog::LevelOfDetail level) {
  const double size = std::cbrt(level.mass_properties.volume);
  for (catalog::ConvexPart& part : level.parts) {
    for (catalog::Point& p : part.vertices)
      for (double& x : p) x /= size;
    for (catalog::ConvexFace& face : part.faces) face.plane.offset /= size;
  }
  return dem_gpu::polyhedral_shape("level", level.parts);
}

}  // namespace

double measured_contact_cost(const catalog::LevelOfDetail& level) {
  const dem_gpu::Shape cube = box_shape({1, 1, 1}), body = unit_shape(level);
  return time_per_pair(body, body, kLaw) / time_per_pair(cube, cube, kLaw);
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
