// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "catalog/shape_record.h"

namespace shape_pipeline {

/// A made (not scanned) mesh as a shape: brought to centroid and principal axes, checked (closed, one component, Euler
/// number, positive volume, volume over its hull's, "self_intersections") and described. Name and provenance are left
/// to the caller.
catalog::ShapeRecord described_shape(const catalog::TriangleMesh& mesh, int genus);

/// What the size of a particle means.
enum class SizeDefinition {
  sieve,   // intermediate side of the box of least volume
  volume,  // diameter of the sphere of equal volume
  feret,   // largest distance of two points
};

/// "sieve", "volume", "feret".
SizeDefinition size_definition(const std::string& word);  // throws InputError for another word

/// The mesh scaled to that size [m].
catalog::TriangleMesh scaled_to_size(const catalog::TriangleMesh& mesh, double size, SizeDefinition definition);

/// The mesh scaled to that volume [m3] about the origin.
catalog::TriangleMesh scaled_to_volume(catalog::TriangleMesh mesh, double volume);

}  // namespace shape_pipeline
