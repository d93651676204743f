// SPDX-License-Identifier: Apache-2.0
#include "postprocess/report/viewer_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "postprocess/contact_statistics.h"
#include "postprocess/pictures/machine.h"
#include "postprocess/report/base64.h"
#include "postprocess/surfaces/surface.h"

namespace postprocess {
namespace {

using dem_gpu::Vec3;
using nlohmann::ordered_json;

constexpr int kSphereLevels = 2;
constexpr std::size_t kBytesPerBody = 15;        // of one frame, as laid out in the header
constexpr std::size_t kFrameBudget = 4'000'000;  // all frames together [bytes]
constexpr std::size_t kMostFrames = 60;

std::int16_t signed_share(double value) {
  return static_cast<std::int16_t>(std::lround(32767 * std::clamp(value, -1.0, 1.0)));
}

ordered_json mesh_json(const Surface& surface, bool is_round, bool is_solid) {
  double radius = 0;
  for (const Vec3& point : surface.points) radius = std::max(radius, norm(point));
  if (radius == 0) radius = 1;
  std::vector<std::int16_t> corners;
  for (const Vec3& point : surface.points)
    for (const double x : {point.x, point.y, point.z}) corners.push_back(signed_share(x / radius));
  std::vector<std::uint32_t> triangles;
  for (int p = 0; p < surface.polygon_count(); ++p)
    for (int c = surface.polygon_begin(p) + 2; c < surface.polygon_end[p]; ++c)
      for (const int corner : {surface.polygon_begin(p), c - 1, c})
        triangles.push_back(static_cast<std::uint32_t>(surface.corners[corner]));
  return {{"corners", base64_of(corners)},
          {"triangles", base64_of(triangles)},
          {"radius", radius},
          {"round", is_round},
          {"solid", is_solid}};
}

/// The box of all bodies' centres.
Bounds centre_bounds(const std::vector<dem_gpu::Snapshot>& frames) {
  Bounds bounds;
  for (const dem_gpu::Snapshot& frame : frames)
    for (std::size_t b = 0; b < frame.position.size(); ++b)
      if (frame.active[b]) bounds.include(frame.position[b]);
  if (bounds.is_empty()) bounds.include({});
  return bounds;
}

ordered_json frame_json(const dem_gpu::Snapshot& frame, const Bounds& bounds, double fastest) {
  std::vector<std::uint16_t> place;
  std::vector<std::int16_t> turn;
  std::vector<std::uint8_t> speed;
  const auto share = [](double x, double low, double high) {
    const double s = high > low ? std::clamp((x - low) / (high - low), 0.0, 1.0) : 0.0;
    return static_cast<std::uint16_t>(std::lround(65535 * s));
  };
  for (std::size_t b = 0; b < frame.position.size(); ++b) {
    const Vec3& p = frame.position[b];
    place.insert(place.end(), {share(p.x, bounds.low.x, bounds.high.x), share(p.y, bounds.low.y, bounds.high.y),
                               share(p.z, bounds.low.z, bounds.high.z)});
    const dem_gpu::Quaternion& q = frame.orientation[b];
    for (const double x : {q.x, q.y, q.z, q.w}) turn.push_back(signed_share(x));
    const double of_fastest = std::clamp(norm(frame.velocity[b]) / fastest, 0.0, 1.0);
    speed.push_back(frame.active[b] ? static_cast<std::uint8_t>(std::lround(254 * of_fastest)) : std::uint8_t{255});
  }
  std::vector<float> walls;
  for (std::size_t w = 0; w < frame.wall_rotation.size(); ++w) {
    const Vec3& t = frame.wall_translation[w];
    const dem_gpu::Quaternion& q = frame.wall_rotation[w];
    for (const double x : {t.x, t.y, t.z, q.x, q.y, q.z, q.w, frame.wall_present[w] ? 1.0 : 0.0})
      walls.push_back(static_cast<float>(x));
  }
  return {{"time", frame.time},
          {"place", base64_of(place)},
          {"turn", base64_of(turn)},
          {"speed", base64_of(speed)},
          {"walls", base64_of(walls)}};
}

ordered_json triple(const Vec3& v) { return ordered_json::array({v.x, v.y, v.z}); }

}  // namespace

std::size_t viewer_frame_limit(std::size_t bodies) {
  return std::clamp<std::size_t>(kFrameBudget / (kBytesPerBody * std::max<std::size_t>(bodies, 1)), 1, kMostFrames);
}

std::string viewer_scene_json(const dem_gpu::RunGeometry& geometry, const std::vector<dem_gpu::Snapshot>& frames,
                              const PictureView& view, const Vec3& vertical) {
  ordered_json scene;
  scene["shapes"] = ordered_json::array();
  for (const dem_gpu::ShapeGeometry& shape : geometry.shapes)
    scene["shapes"].push_back(mesh_json(shape_surface(shape, kSphereLevels), shape.sphere_radius > 0, true));
  Bounds whole;
  for (const dem_gpu::Snapshot& frame : frames) {
    check_same_run(geometry, frame);
    const Bounds bounds = scene_bounds(geometry, frame);
    if (bounds.is_empty()) continue;
    whole.include(bounds.low);
    whole.include(bounds.high);
  }
  scene["walls"] = ordered_json::array();
  const Machine machine = machine_of(geometry.walls, vertical);
  for (const dem_gpu::WallGeometry& wall : geometry.walls)
    scene["walls"].push_back(mesh_json(wall_surface(as_drawn(wall, machine), whole, 64), false,
                                       wall.kind == dem_gpu::WallKind::volume_object));
  std::vector<std::uint16_t> shape_of(geometry.body_shape.begin(), geometry.body_shape.end());
  std::vector<float> scale_of(geometry.body_scale.begin(), geometry.body_scale.end());
  scene["shapeOf"] = base64_of(shape_of);
  scene["scaleOf"] = base64_of(scale_of);
  const Bounds bounds = centre_bounds(frames);
  scene["low"] = triple(bounds.low);
  scene["span"] = triple(bounds.high - bounds.low);
  scene["eye"] = triple(view.eye);
  scene["focus"] = triple(view.focus);
  scene["up"] = triple(view.up);
  scene["vertical"] = triple(vertical);
  scene["angle"] = view.view_angle;
  scene["frames"] = ordered_json::array();
  for (const dem_gpu::Snapshot& frame : frames) scene["frames"].push_back(frame_json(frame, bounds, view.fastest));
  return scene.dump();
}

}  // namespace postprocess
