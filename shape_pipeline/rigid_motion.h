// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/mass_properties.h"
#include "catalog/triangle_mesh.h"
#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// x -> rotation x + shift: from the frame of what is moved to that of what it is fitted to.
struct RigidMotion {
  catalog::Matrix3 rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // proper
  catalog::Point shift{};                                        // [m]
};

catalog::Point turned(const RigidMotion& motion, const catalog::Point& direction);
catalog::Point moved(const RigidMotion& motion, const catalog::Point& point);
PointCloud moved(const RigidMotion& motion, PointCloud cloud);
catalog::TriangleMesh moved(const RigidMotion& motion, catalog::TriangleMesh mesh);

/// First `first`, then `second`.
RigidMotion chained(const RigidMotion& second, const RigidMotion& first);
RigidMotion inverse(const RigidMotion& motion);

/// Of the rotation [rad], 0 to pi.
double rotation_angle(const RigidMotion& motion);

}  // namespace shape_pipeline
