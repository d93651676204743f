// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/virtual_parts.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/virtual_scan.h"

namespace shape_pipeline {
namespace {

constexpr double kMissedCap = 0.35;           // of all directions
constexpr double kReach = 0.2;                // of the random shifts [m]
constexpr double kHiddenSine = 0.87;          // 60 degrees
constexpr double kPitch = 0.06, kRim = 0.04;  // of rocks of 0.03 m on a plate, and of the plate about them [m]
constexpr int kPlatePoints = 3000;            // a rock

RigidMotion random_motion(RandomStream& random) {
  const Point axis = random.direction(), across = normalized(cross(axis, random.direction()));
  return {{axis, across, cross(axis, across)}, scaled(random.direction(), kReach)};
}

}  // namespace

VirtualParts virtual_parts(const catalog::TriangleMesh& mesh, int count, std::uint64_t seed, double noise) {
  RandomStream random(seed);
  VirtualParts result;
  result.diagonal = bounding_diagonal(mesh.vertices);
  RigidMotion first;
  for (int p = 0; p < count; ++p) {
    ScannerFlaws flaws;
    flaws.seed = random.bits();
    flaws.noise_sigma = noise;
    flaws.gap_angle = std::acos(1 - 2 * kMissedCap);
    const RigidMotion motion = random_motion(random);
    if (p == 0) first = motion;
    result.parts.push_back({"part" + std::to_string(p + 1) + ".ply", moved(motion, virtual_scan(mesh, flaws))});
    result.truth.push_back(chained(first, inverse(motion)));
  }
  result.centre = first.shift;
  return result;
}

PoseError worst_pose_error(const RegisteredParts& found, const VirtualParts& known) {
  PoseError worst;
  for (std::size_t p = 1; p < known.parts.size(); ++p) {
    const RigidMotion error = chained(found.motions[p], inverse(known.truth[p]));
    worst.rotation = std::max(worst.rotation, rotation_angle(error));
    worst.shift = std::max(worst.shift, distance(moved(error, known.centre), known.centre) / known.diagonal);
  }
  return worst;
}

VirtualPlate virtual_plate(int rocks, int points_each, double noise) {
  VirtualPlate plate;
  RandomStream random(7);
  for (int r = 0; r < rocks; ++r) {
    RockRecipe recipe;
    recipe.seed = static_cast<std::uint64_t>(r + 1);
    const catalog::TriangleMesh rock = virtual_rock(recipe);
    double lowest = 0;
    for (const Point& vertex : rock.vertices) lowest = std::min(lowest, vertex[2]);
    plate.volumes.push_back(signed_volume(rock));
    ScannerFlaws flaws;
    flaws.seed = random.bits();
    flaws.points = points_each;
    flaws.gap_angle = 0;
    flaws.stray_points = 0;
    flaws.noise_sigma = noise;
    for (const Point& point : virtual_scan(rock, flaws).points)
      if (point[2] > -kHiddenSine * norm(point)) plate.cloud.points.push_back(add(point, {kPitch * r, 0, -lowest}));
  }
  const double length = kPitch * (rocks - 1) + 2 * kRim;
  plate.plate_points = static_cast<std::size_t>(kPlatePoints) * static_cast<std::size_t>(rocks);
  for (std::size_t i = 0; i < plate.plate_points; ++i)
    plate.cloud.points.push_back(
        {random.uniform(0, length) - kRim, random.uniform(-kRim, kRim), noise * random.normal()});
  const RigidMotion tilt{{{{0.6, 0, 0.8}, {0, 1, 0}, {-0.8, 0, 0.6}}}, {0.3, 0.1, -0.2}};
  plate.cloud = moved(tilt, plate.cloud);
  plate.normal = turned(tilt, {0, 0, 1});
  return plate;
}

}  // namespace shape_pipeline
