// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"

namespace decomposition {

/// What a closed surface, connected by shared vertices, is to the point set of positive winding number.
enum class PieceRole {
  body,     // bounds rock from outside: outward, no rock around it
  cavity,   // bounds rock from inside: inward, in rock
  inner,    // lies in rock and bounds none: what it encloses is counted twice, or once of several times
  inverted  // encloses less than nothing: inward with no rock around it
};

struct SurfacePiece {
  PieceRole role = PieceRole::body;
  double volume = 0;  // signed [m3]
  int body = -1;      // of a cavity: the piece whose rock it lies in; else -1
};

struct SurfacePieces {
  std::vector<int> piece_of;  // (n_faces)
  std::vector<SurfacePiece> pieces;

  int count(PieceRole role) const;
};

/// Number of connected surfaces, at no more cost than a pass over the faces.
int count_pieces(const catalog::TriangleMesh& mesh);

/// The connected surfaces of a closed mesh and how they lie in one another. Surfaces that
/// cross count as apart: the winding numbers tell (see MiscountedVolume). Time grows with pieces x faces.
SurfacePieces surface_pieces(const catalog::TriangleMesh& mesh);

/// Adds a face of the mesh to `result`, and those of its vertices that are new there. `number` (n_vertices) is where
/// the mesh's vertices stand in `result`, -1: not yet.
void add_face(const catalog::TriangleMesh& mesh, std::size_t face, std::vector<int>& number,
              catalog::TriangleMesh& result);

/// Adds all vertices and faces of a mesh to another.
void add_mesh(const catalog::TriangleMesh& other, catalog::TriangleMesh& mesh);

/// The bodies of a mesh one by one, each with its cavities, in the order of first appearance; none if the mesh is a
/// single body, or has surfaces that are neither body nor cavity.
std::vector<catalog::TriangleMesh> separate_bodies(const catalog::TriangleMesh& mesh);

/// The same, with bodies whose boxes meet in one mesh; none if that makes one.
std::vector<catalog::TriangleMesh> bodies_apart(const catalog::TriangleMesh& mesh);

}  // namespace decomposition
