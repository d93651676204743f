// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/rigid_motion.h"

#include <algorithm>
#include <cmath>

#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {

Point turned(const RigidMotion& motion, const Point& direction) {
  Point result;
  for (int i = 0; i < 3; ++i)
    result[i] = motion.rotation[i][0] * direction[0] + motion.rotation[i][1] * direction[1] +
                motion.rotation[i][2] * direction[2];
  return result;
}

Point moved(const RigidMotion& motion, const Point& point) { return add(turned(motion, point), motion.shift); }

PointCloud moved(const RigidMotion& motion, PointCloud cloud) {
  for (Point& point : cloud.points) point = moved(motion, point);
  for (Point& normal : cloud.normals) normal = turned(motion, normal);
  return cloud;
}

catalog::TriangleMesh moved(const RigidMotion& motion, catalog::TriangleMesh mesh) {
  for (Point& vertex : mesh.vertices) vertex = moved(motion, vertex);
  return mesh;
}

RigidMotion chained(const RigidMotion& second, const RigidMotion& first) {
  RigidMotion result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      result.rotation[i][j] = 0;
      for (int k = 0; k < 3; ++k) result.rotation[i][j] += second.rotation[i][k] * first.rotation[k][j];
    }
  result.shift = moved(second, first.shift);
  return result;
}

RigidMotion inverse(const RigidMotion& motion) {
  RigidMotion result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result.rotation[i][j] = motion.rotation[j][i];
  result.shift = scaled(turned(result, motion.shift), -1);
  return result;
}

double rotation_angle(const RigidMotion& motion) {
  // The sine by the antisymmetric part: the cosine alone loses half the digits of a small angle.
  const catalog::Matrix3& r = motion.rotation;
  const Point twice_sine{r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]};
  return std::atan2(norm(twice_sine), r[0][0] + r[1][1] + r[2][2] - 1);
}

}  // namespace shape_pipeline
