// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

constexpr double kSpeckShare = 0.001;        // of the area: a body of such a surface has 3e-5 of the volume
constexpr std::size_t kMostSurfaces = 1000;  // more is a cloud of scraps

/// What a surface is to the solid.
enum class PieceRole {
  body,    // lies in no body; turned outwards
  cavity,  // lies in a body and is turned inwards
  inner    // lies in a body and is turned outwards: bounds nothing
};

/// One surface of a mesh, connected by edges; it may have holes.
struct SurfacePiece {
  catalog::TriangleMesh mesh;
  catalog::Point low{}, high{};  // of its box [m]
  double area = 0;               // [m2]
  double volume = 0;             // signed [m3]
  PieceRole role = PieceRole::body;
};

/// The surfaces in the order of first appearance, their roles not yet found.
std::vector<SurfacePiece> surface_pieces(const catalog::TriangleMesh& mesh);

/// Finds the roles and turns bodies that are inside out. Puts the pieces in order from the largest box down. Returns
/// how many were turned. Surfaces that cross count as apart.
std::size_t find_roles(std::vector<SurfacePiece>& pieces);

void turn_round(catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
