// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

inline constexpr std::size_t kMostSurfaces = 1000;  // of a grain; more is a cloud of scraps

/// What a surface is to the solid, that is to the points that more bodies than cavities hold.
enum class PieceRole {
  body,   // turned outwards
  cavity  // turned inwards, in a body
};

/// One surface of a mesh, connected by edges; it may have holes.
struct SurfacePiece {
  catalog::TriangleMesh mesh;
  catalog::Point low{}, high{};  // of its box [m]
  double area = 0;               // [m2]
  double volume = 0;             // signed [m3]
  PieceRole role = PieceRole::body;
  int body = -1;           // of a cavity: the smallest body that holds it
  bool is_nested = false;  // a body that lies in another
};

/// The surfaces in the order of first appearance, their roles not yet found.
std::vector<SurfacePiece> surface_pieces(const catalog::TriangleMesh& mesh);

/// Finds the roles, putting the pieces in order from the largest box down: a surface that is turned inwards and lies in
/// a body is its cavity, any other is a body. Bodies that are inside out are turned; so are all surfaces if they hold
/// less than nothing together. Returns how many were turned.
std::size_t find_roles(std::vector<SurfacePiece>& pieces);

void turn_round(catalog::TriangleMesh& mesh);
void append(const catalog::TriangleMesh& other, catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
