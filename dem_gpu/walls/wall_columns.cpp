// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/walls/wall_columns.h"

#include <algorithm>
#include <cmath>

namespace dem_gpu {
namespace {

/// Integral of the speed ramp from start_time: the time at full speed that gives the same travel [s].
Real effective_time(const Motion& motion, Real time) {
  const Real elapsed = time - motion.start_time;
  if (elapsed <= 0) return 0;
  if (motion.ramp_time <= 0) return elapsed;
  if (elapsed < motion.ramp_time) return elapsed * elapsed / (2 * motion.ramp_time);
  return elapsed - motion.ramp_time / 2;
}

Real speed_share(const Motion& motion, Real time) {
  const Real elapsed = time - motion.start_time;
  if (elapsed <= 0) return 0;
  return motion.ramp_time > 0 ? std::min(Real(1), elapsed / motion.ramp_time) : Real(1);
}

Quaternion rotation_at(const Motion& motion, Real time) {
  const Real rate = norm(motion.angular_velocity);
  if (rate == 0) return {};
  return axis_angle(motion.angular_velocity / rate, rate * effective_time(motion, time));
}

struct MakeRecord {
  int next_shape;
  int next_mesh;

  WallRecord operator()(const Plane& plane) const {
    WallRecord record;
    record.kind = WallKind::plane;
    record.point = plane.point;
    record.direction = plane.normal;
    return record;
  }
  WallRecord operator()(const Disc& disc) const {
    WallRecord record;
    record.kind = WallKind::disc;
    record.point = disc.centre;
    record.direction = disc.normal;
    record.base_radius = disc.radius;
    return record;
  }
  WallRecord operator()(const Cylinder& cylinder) const {
    WallRecord record;
    record.kind = WallKind::cylinder;
    record.point = cylinder.base;
    record.direction = cylinder.axis;
    record.length = cylinder.length;
    record.base_radius = record.top_radius = cylinder.radius;
    return record;
  }
  WallRecord operator()(const Cone& cone) const {
    WallRecord record;
    record.kind = WallKind::cone;
    record.point = cone.base;
    record.direction = cone.axis;
    record.length = cone.length;
    record.base_radius = cone.base_radius;
    record.top_radius = cone.top_radius;
    return record;
  }
  WallRecord operator()(const VolumeObject& object) const {
    WallRecord record;
    record.kind = WallKind::volume_object;
    record.shape = next_shape;
    for (const catalog::Point& vertex : object.part.vertices)
      record.bounding_radius = std::max(record.bounding_radius, norm(Vec3{vertex[0], vertex[1], vertex[2]}));
    return record;  // the shape stands in the world frame at time 0: pose is the identity
  }
  WallRecord operator()(const MeshObject&) const {
    WallRecord record;
    record.kind = WallKind::mesh;
    record.mesh = next_mesh;
    return record;  // as a volume object
  }
};

/// True if turning about the axis through `centre` leaves the surface where it is.
bool maps_onto_itself(const WallRecord& record, const Vec3& centre, const Vec3& axis) {
  if (norm(cross(record.direction, axis)) > 1e-9) return false;
  if (record.kind == WallKind::plane) return true;
  const Vec3 offset = record.point - centre;
  return norm(offset - dot(offset, axis) * axis) < 1e-9 && record.kind != WallKind::volume_object &&
         record.kind != WallKind::mesh;
}

Real reach_from_axis(const Wall& wall, const WallRecord& record) {
  const Real rate = norm(wall.motion.angular_velocity);
  if (rate == 0) return 0;
  const Vec3 axis = wall.motion.angular_velocity / rate;
  const auto distance = [&](const Vec3& x) {
    const Vec3 offset = x - wall.motion.rotation_centre;
    return norm(offset - dot(offset, axis) * axis);
  };
  const auto farthest = [&](const std::vector<catalog::Point>& vertices) {
    Real reach = 0;
    for (const catalog::Point& vertex : vertices) reach = std::max(reach, distance({vertex[0], vertex[1], vertex[2]}));
    return reach;
  };
  if (const auto* object = std::get_if<VolumeObject>(&wall.geometry)) return farthest(object->part.vertices);
  // A sheet's back stands out by less than a few thicknesses.
  if (const auto* mesh = std::get_if<MeshObject>(&wall.geometry))
    return farthest(mesh->mesh.vertices) + 4 * mesh->thickness.value_or(0);
  if (maps_onto_itself(record, wall.motion.rotation_centre, axis)) return 0;
  return distance(record.point) + record.length + std::max(record.base_radius, record.top_radius) + 1;
}

}  // namespace

WallSet::WallSet(const Scene& scene, int first_shape) : walls_(scene.walls) {
  int next_mesh = 0;
  for (const Wall& wall : walls_) {
    WallRecord record = std::visit(MakeRecord{first_shape, next_mesh}, wall.geometry);
    if (record.kind == WallKind::volume_object) ++first_shape;
    if (record.kind == WallKind::mesh) ++next_mesh;
    record.material = wall.material;
    record.rotation_centre = wall.motion.rotation_centre;
    at_start_.push_back(record);
    reach_.push_back(reach_from_axis(wall, record));
  }
  now_ = at_start_;
  move_to(0);
}

Vec3 WallSet::translation(int wall) const {
  const Motion& motion = walls_[wall].motion;
  return motion.rotation_centre - rotate(rotation(wall), motion.rotation_centre) +
         effective_time(motion, time_) * motion.velocity;
}

Quaternion WallSet::rotation(int wall) const { return rotation_at(walls_[wall].motion, time_); }

bool WallSet::move_to(Real time) {
  time_ = time;
  bool has_changed = false;
  for (int w = 0; w < count(); ++w) {
    const Motion& motion = walls_[w].motion;
    const Quaternion turn = rotation(w);
    const Vec3 shift = translation(w);
    const bool is_present = !walls_[w].removed_at || time < *walls_[w].removed_at;
    has_changed |= is_present != now_[w].is_present;
    now_[w].is_present = is_present;
    now_[w].point = rotate(turn, at_start_[w].point) + shift;
    now_[w].direction = rotate(turn, at_start_[w].direction);
    now_[w].orientation = turn;
    now_[w].rotation_centre = motion.rotation_centre + effective_time(motion, time) * motion.velocity;
    now_[w].velocity = speed_share(motion, time) * motion.velocity;
    now_[w].angular_velocity = speed_share(motion, time) * motion.angular_velocity;
  }
  assign(device_, now_);
  return has_changed;
}

Real WallSet::largest_displacement(Real from, Real to) const {
  Real largest = 0;
  for (int w = 0; w < count(); ++w) {
    const Motion& motion = walls_[w].motion;
    const Real span = effective_time(motion, to) - effective_time(motion, from);
    largest = std::max(largest, std::abs(span) * (norm(motion.velocity) + reach_[w] * norm(motion.angular_velocity)));
  }
  return largest;
}

bool WallSet::has_moving_walls() const {
  return std::any_of(walls_.begin(), walls_.end(), [](const Wall& wall) {
    return norm(wall.motion.velocity) > 0 || norm(wall.motion.angular_velocity) > 0 || wall.removed_at;
  });
}

}  // namespace dem_gpu
