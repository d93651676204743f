// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "decomposition/geometry/vector3.h"

namespace decomposition {

/// Affine frame in which a needle or a plate is about as wide as thick. The symmetric difference of two bodies over a
/// volume, convexity, planes and partitions are the same in every such frame, lengths and angles are not: steps of a
/// fit, its margins and the rules on edges and faces suit round bodies. Compact bodies stay as they are.
class RoundFrame {
 public:
  RoundFrame() = default;  // leaves all as it is
  /// Of a solid with its principal axes; as it is, unless they differ by more than kLongestCompact.
  explicit RoundFrame(const catalog::TriangleMesh& mesh);

  bool is_identity() const { return is_identity_; }
  catalog::TriangleMesh to_round(catalog::TriangleMesh mesh) const;
  Vec3 to_real(const Vec3& p) const;
  /// The same half-space; the reversed plane becomes the reversed one bit for bit.
  Plane to_real(const Plane& plane) const;

 private:
  bool is_identity_ = true;
  Vec3 centre_;
  std::array<Vec3, 3> axes_;                // principal, unit, right-handed
  std::array<double, 3> stretch_{1, 1, 1};  // along them, from the round frame to the real one: a power of two, >= 1
};

/// Smallest extent of points over directions spread in the frame, and its axes: a little above their true width.
double smallest_extent(const std::vector<Vec3>& points, const RoundFrame& frame);

}  // namespace decomposition
