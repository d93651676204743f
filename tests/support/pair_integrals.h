// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "dem_gpu/contacts/body_overlap.h"
#include "tests/support/dem_scenes.h"
#include "tests/support/precision.h"

namespace test_support {

/// Where a body stands.
struct Placed {
  Vec3 position;
  Quaternion orientation;
  Real scale = 1;

  dem_gpu::Pose pose() const { return {rotation_matrix(orientation), position, scale}; }
};

/// Two bodies on the host, for calling the narrow phase as a contact kernel does.
class PairIntegrals {
 public:
  PairIntegrals(std::vector<catalog::ConvexPart> a, std::vector<catalog::ConvexPart> b, Real depth_cap = 100)
      : columns_(dem_gpu::make_host_shape_columns({shape(std::move(a)), shape(std::move(b))}, depth_cap)) {}

  /// `integrals`: as they are before any overlap.
  template <class Integrals>
  Integrals of(const Placed& a, const Placed& b, bool swapped = false, Integrals integrals = {}) const {
    std::vector<dem_gpu::SeparatingPlane> cache(columns_.parts.size() * columns_.parts.size(), 0);
    const int first = swapped ? 1 : 0;
    dem_gpu::integrate_bodies(view(columns_), first, 1 - first, a.pose(), b.pose(), cache.data(), integrals);
    return integrals;
  }
  /// [m3]; the integrals themselves are in a's unscaled frame.
  Real volume(const Placed& a, const Placed& b) const {
    return a.scale * a.scale * a.scale * of<dem_gpu::VolumeIntegrals>(a, b).volume;
  }

  const dem_gpu::HostShapeColumns& columns() const { return columns_; }

 private:
  static dem_gpu::Shape shape(std::vector<catalog::ConvexPart> parts) {
    Real volume = 0;
    for (const catalog::ConvexPart& part : parts) volume += catalog::volume_moments(triangulated(part)).volume;
    return {"", dem_gpu::PolyhedralShape{std::move(parts)}, volume, {}};
  }
  dem_gpu::HostShapeColumns columns_;
};

}  // namespace test_support
