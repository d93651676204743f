// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dem_gpu/scene.h"

namespace dem_gpu {

struct BodyPose {
  Vec3 position{};  // of the shape's origin [m]
  Quaternion orientation{};
  Real scale = 1;
};

struct PosePair {
  BodyPose a, b;
};

/// Overlap of two bodies as a solid, world frame.
struct OverlapSolid {
  Real volume = 0;   // V [m3]
  Vec3 area;         // S, vector area of a's surface inside b [m2]
  Vec3 area_moment;  // M, integral over the same of x cross n dA, x from a's position [m3]
  Vec3 centroid;     // [m]; the world's origin where there is no overlap
};

/// Elastic contact of two bodies, world frame; all zero where they do not touch.
struct ProbeContact {
  Vec3 force;          // on a; b gets the opposite [N]
  Vec3 torque_a;       // on a, about its origin [N m]
  Vec3 point;          // [m]
  Real depth = 0;      // [m]
  Real stiffness = 0;  // tangent stiffness dF/d(depth) [N/m]
};

/// The face plane that last separated each pair of parts of each pair of poses; starts empty.
using SeparationCache = std::vector<std::int16_t>;

/// The engine's narrow phase of two polyhedral bodies by itself: one pair of poses at a time, on the calling thread,
/// with the functions that the contact pass runs. For benchmarks, tests and studies of contact laws.
class OverlapProbe {
 public:
  /// Shapes are taken in the frame they are given in (they need not be centred). Throws catalog::InputError for a
  /// sphere.
  OverlapProbe(const Shape& a, const Shape& b, const PolyhedralLaw& law);
  ~OverlapProbe();
  OverlapProbe(OverlapProbe&&) noexcept;

  /// Throws std::runtime_error if a clipped polygon outgrew its buffer; so do the functions below.
  OverlapSolid overlap(const PosePair& poses) const;
  ProbeContact contact(const PosePair& poses) const;

  /// As contact() for each pair in turn, each with its own cached separating planes, like successive steps of a run.
  /// Returns how many pairs touch.
  int count_contacts(std::span<const PosePair> pairs, SeparationCache& cache) const;

 private:
  struct Columns;
  std::unique_ptr<Columns> columns_;
};

}  // namespace dem_gpu
