// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "dem_gpu/scene.h"

namespace dem_gpu {

/// Distance of points from a mesh wall at time 0.
class MeshProbe {
 public:
  /// Throws catalog::InputError as check(scene) does, without the wall's name.
  explicit MeshProbe(const MeshObject& object);
  ~MeshProbe();
  MeshProbe(MeshProbe&&) noexcept;

  /// Of x from the surface, negative in the solid [m].
  Real distance(const Vec3& x) const;

 private:
  struct Columns;
  std::unique_ptr<Columns> columns_;
};

}  // namespace dem_gpu
