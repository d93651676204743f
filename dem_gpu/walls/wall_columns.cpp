// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/walls/wall_columns.h"

#include <algorithm>
#include <cmath>

#include "dem_gpu/walls/wall_motion.h"

namespace dem_gpu {
namespace {

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
    record.side = any_perpendicular(disc.normal);
    record.thickness = disc.thickness.value_or(0);
    return record;
  }
  WallRecord operator()(const Cylinder& cylinder) const {
    WallRecord record;
    record.kind = WallKind::cylinder;
    record.point = cylinder.base;
    record.direction = cylinder.axis;
    record.length = cylinder.length;
    record.base_radius = record.top_radius = cylinder.radius;
    record.solid_within = cylinder.solid == SolidSide::within;
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
    record.solid_within = cone.solid == SolidSide::within;
    return record;
  }
  WallRecord operator()(const Ball& ball) const {
    WallRecord record;
    record.kind = WallKind::sphere;
    record.point = ball.centre;
    record.direction = {0, 0, 1};
    record.base_radius = record.top_radius = ball.radius;
    record.solid_within = ball.solid == SolidSide::within;
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
  if (record.kind == WallKind::sphere) return norm(cross(record.point - centre, axis)) < 1e-9;
  if (norm(cross(record.direction, axis)) > 1e-9) return false;
  if (record.kind == WallKind::plane) return true;
  const Vec3 offset = record.point - centre;
  return norm(offset - dot(offset, axis) * axis) < 1e-9 && record.kind != WallKind::volume_object &&
         record.kind != WallKind::mesh;
}

/// Largest distance of a wall's surface from the axis of a rotation vector, which may itself be turned (`turns`); 0 if
/// the surface maps onto itself [m].
Real reach_from_axis(const Wall& wall, const WallRecord& record, const Vec3& rotation, bool turns) {
  const Real rate = norm(rotation);
  if (rate == 0) return 0;
  const Vec3 axis = rotation / rate;
  if (maps_onto_itself(record, wall.motion.rotation_centre, axis)) return 0;
  const auto distance = [&](const Vec3& x) {
    const Vec3 offset = x - wall.motion.rotation_centre;
    return turns ? norm(offset) : norm(offset - dot(offset, axis) * axis);
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
  return distance(record.point) + record.length + std::max(record.base_radius, record.top_radius) + 1;
}

/// Are two rims one circle, to within a millionth of it?
bool is_one_rim(const WallRecord& a, bool at_top, const WallRecord& b, bool b_at_top) {
  const auto centre = [](const WallRecord& wall, bool top) {
    return wall.point + (top ? wall.length : Real(0)) * wall.direction;
  };
  const Real radius = at_top ? a.top_radius : a.base_radius, other = b_at_top ? b.top_radius : b.base_radius;
  const Real tolerance = Real(1e-6) * radius;
  return radius > 0 && std::abs(radius - other) < tolerance &&
         norm(centre(a, at_top) - centre(b, b_at_top)) < tolerance &&
         norm(cross(a.direction, b.direction)) < Real(1e-6) && a.solid_within == b.solid_within;
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
    const Motion& motion = wall.motion;
    const bool turns = norm(motion.angular_velocity) > 0 && is_oscillating(motion);
    turn_reach_.push_back(reach_from_axis(wall, record, motion.angular_velocity, turns));
    swing_reach_.push_back(reach_from_axis(wall, record, motion.angular_amplitude, turns));
  }
  join_rims();
  now_ = at_start_;
  move_to(0);
}

void WallSet::join_rims() {
  const auto is_round = [&](int w) {
    return at_start_[w].kind == WallKind::cylinder || at_start_[w].kind == WallKind::cone;
  };
  for (int a = 0; a < static_cast<int>(at_start_.size()); ++a)
    for (int b = 0; b < static_cast<int>(at_start_.size()); ++b) {
      if (a == b || !is_round(a) || !is_round(b)) continue;
      const Motion &motion = walls_[a].motion, &other = walls_[b].motion;
      const bool both_spin = norm(motion.velocity) == 0 && norm(other.velocity) == 0 && !is_oscillating(motion) &&
                             !is_oscillating(other) && turn_reach_[a] == 0 && turn_reach_[b] == 0;
      if (!(motion == other) && !both_spin) continue;
      for (const bool at_top : {false, true})
        for (const bool other_at_top : {false, true})
          if (is_one_rim(at_start_[a], at_top, at_start_[b], other_at_top)) at_start_[a].rim_neighbour[at_top] = b;
    }
}

void WallSet::weld(const std::vector<std::vector<int>>& welds) {
  std::vector<int> all;
  for (std::size_t w = 0; w < welds.size(); ++w) {
    now_[w].first_weld = static_cast<int>(all.size());
    now_[w].weld_count = static_cast<int>(welds[w].size());
    all.insert(all.end(), welds[w].begin(), welds[w].end());
  }
  assign(welds_, all);
  assign(device_, now_);
}

Vec3 WallSet::translation(int wall) const {
  const Motion& motion = walls_[wall].motion;
  return motion.rotation_centre - rotate(rotation(wall), motion.rotation_centre) + place_at(motion, time_).shift;
}

Quaternion WallSet::rotation(int wall) const { return place_at(walls_[wall].motion, time_).rotation; }

bool WallSet::move_to(Real time) {
  const Real before = time_;
  time_ = time;
  bool has_changed = false;
  for (int w = 0; w < count(); ++w) {
    const Motion& motion = walls_[w].motion;
    const Quaternion turn = rotation(w);
    const Vec3 shift = translation(w);
    const bool is_present = is_present_at(w, time);
    const WallRate rate = rate_at(motion, time), mean = mean_rate(motion, before, time);
    has_changed |= is_present != now_[w].is_present;
    now_[w].is_present = is_present;
    now_[w].point = rotate(turn, at_start_[w].point) + shift;
    now_[w].direction = rotate(turn, at_start_[w].direction);
    now_[w].orientation = turn;
    now_[w].rotation_centre = motion.rotation_centre + place_at(motion, time).shift;
    now_[w].velocity = rate.velocity;
    now_[w].angular_velocity = rate.angular_velocity;
    now_[w].mean_velocity = mean.velocity;
    now_[w].mean_angular_velocity = mean.angular_velocity;
  }
  assign_launched(device_, now_);
  return has_changed;
}

Real WallSet::displacement(int wall, const WallTravel& gone) const {
  return gone.shift + turn_reach_[wall] * gone.turn + swing_reach_[wall] * gone.swing;
}

Real WallSet::largest_displacement(Real from, Real to) const {
  Real largest = 0;
  for (int w = 0; w < count(); ++w) largest = std::max(largest, displacement(w, travel(walls_[w].motion, from, to)));
  return largest;
}

Real WallSet::largest_displacement(Real span) const {
  return count() > 0 ? bound_of_displacement(fastest(span), span) : Real(0);
}

int WallSet::fastest(Real span) const {
  int fastest = 0;
  for (int w = 1; w < count(); ++w)
    if (bound_of_displacement(w, span) > bound_of_displacement(fastest, span)) fastest = w;
  return fastest;
}

Real WallSet::bound_of_displacement(int wall, Real span) const {
  return displacement(wall, largest_travel(walls_[wall].motion, span));
}

bool WallSet::is_present_at(int wall, Real time) const {
  return !walls_[wall].removed_at || time < *walls_[wall].removed_at;
}

bool WallSet::any_moves() const {
  return std::any_of(walls_.begin(), walls_.end(), [](const Wall& wall) { return is_moving(wall.motion); });
}

bool WallSet::comes_or_goes(Real time) const {
  for (int w = 0; w < count(); ++w)
    if (is_present_at(w, time) != now_[w].is_present) return true;
  return false;
}

bool WallSet::has_moving_walls() const {
  return std::any_of(walls_.begin(), walls_.end(),
                     [](const Wall& wall) { return is_moving(wall.motion) || wall.removed_at; });
}

}  // namespace dem_gpu
