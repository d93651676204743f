// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "catalog/triangle_mesh.h"
#include "decomposition/convex_decomposition.h"

namespace decomposition {

/// What was found in a mesh and left out of it before the search.
struct SurfaceNotes {
  int bodies = 1, cavities = 0;  // that remain
  int inner_surfaces = 0;        // left out: they lay in the rock and bounded none
  int other_bodies = 0;          // left out, with their cavities
  double other_volume = 0;       // of these / volume of all bodies
  double miscounted_volume = 0;  // enclosed twice or inside out / volume: surfaces that cut themselves

  std::string json() const;
};

struct SolidSurface {
  std::optional<catalog::TriangleMesh> cleaned;  // none: the mesh as it is
  SurfaceNotes notes;
};

/// The surface of the one solid that the mesh stands for. Throws catalog::InputError if it stands for none, or for
/// several bodies that `bodies` refuses.
SolidSurface solid_surface(const catalog::TriangleMesh& mesh, SeparateBodies bodies);

}  // namespace decomposition
