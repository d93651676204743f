// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/surface_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

/// Share of the directions from p in which the surface is seen from inside: 1 in a closed outward one (van Oosterom and
/// Strackee 1983).
double winding_number(const catalog::TriangleMesh& mesh, const Point& p) {
  double angle = 0;
  for (const catalog::Triangle& face : mesh.faces) {
    const Point a = subtract(mesh.vertices[static_cast<std::size_t>(face[0])], p);
    const Point b = subtract(mesh.vertices[static_cast<std::size_t>(face[1])], p);
    const Point c = subtract(mesh.vertices[static_cast<std::size_t>(face[2])], p);
    const double la = norm(a), lb = norm(b), lc = norm(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

/// Whether `inner` lies in `outer`: all of its box, and the middles of some of its faces.
bool lies_in(const SurfacePiece& inner, const SurfacePiece& outer) {
  for (int i = 0; i < 3; ++i)
    if (inner.low[i] < outer.low[i] || inner.high[i] > outer.high[i]) return false;
  constexpr std::size_t kPlaces = 8;
  const std::size_t count = std::min(inner.mesh.faces.size(), kPlaces);
  for (std::size_t k = 0; k < count; ++k) {
    Point middle{};
    for (const int v : inner.mesh.faces[k * inner.mesh.faces.size() / count])
      middle = add(middle, scaled(inner.mesh.vertices[static_cast<std::size_t>(v)], 1 / 3.0));
    if (std::abs(winding_number(outer.mesh, middle)) < 0.5) return false;
  }
  return true;
}

}  // namespace

void turn_round(catalog::TriangleMesh& mesh) {
  for (catalog::Triangle& face : mesh.faces) std::swap(face[1], face[2]);
}

std::vector<SurfacePiece> surface_pieces(const catalog::TriangleMesh& mesh) {
  const std::vector<int> component = face_components(mesh);
  std::vector<SurfacePiece> pieces(
      component.empty() ? 0 : static_cast<std::size_t>(*std::max_element(component.begin(), component.end())) + 1);
  std::vector<int> number(mesh.vertices.size(), -1), owner(mesh.vertices.size(), -1);
  for (std::size_t f = 0; f < component.size(); ++f) {
    catalog::TriangleMesh& piece = pieces[static_cast<std::size_t>(component[f])].mesh;
    catalog::Triangle face = mesh.faces[f];
    for (int& v : face) {
      const auto old = static_cast<std::size_t>(v);
      if (owner[old] != component[f]) {
        owner[old] = component[f];
        number[old] = static_cast<int>(piece.vertices.size());
        piece.vertices.push_back(mesh.vertices[old]);
      }
      v = number[old];
    }
    piece.faces.push_back(face);
  }
  for (SurfacePiece& piece : pieces) {
    piece.low = piece.high = piece.mesh.vertices.front();
    for (const Point& p : piece.mesh.vertices)
      for (int i = 0; i < 3; ++i) {
        piece.low[i] = std::min(piece.low[i], p[i]);
        piece.high[i] = std::max(piece.high[i], p[i]);
      }
    piece.area = surface_area(piece.mesh);
    piece.volume = signed_volume(piece.mesh);
  }
  return pieces;
}

std::size_t find_roles(std::vector<SurfacePiece>& pieces) {
  double volume = 0;
  for (const SurfacePiece& piece : pieces) volume += piece.volume;
  std::size_t turned = 0;
  const auto turn = [&](SurfacePiece& piece) {
    turn_round(piece.mesh);
    piece.volume = -piece.volume;
    ++turned;
  };
  if (volume < 0)
    for (SurfacePiece& piece : pieces) turn(piece);
  std::stable_sort(pieces.begin(), pieces.end(), [](const SurfacePiece& a, const SurfacePiece& b) {
    return distance(a.low, a.high) > distance(b.low, b.high);
  });
  // None lies in one of a smaller box.
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    SurfacePiece& piece = pieces[p];
    int around = 0;  // bodies less cavities
    for (std::size_t q = 0; q < p; ++q) {
      if (!lies_in(piece, pieces[q])) continue;
      around += pieces[q].role == PieceRole::body ? 1 : -1;
      if (pieces[q].role == PieceRole::body) piece.body = static_cast<int>(q);
    }
    if (around > 0 && piece.volume < 0) {
      piece.role = PieceRole::cavity;
      continue;
    }
    if (piece.volume < 0) turn(piece);
    piece.is_nested = around > 0;
    piece.body = -1;
  }
  return turned;
}

void append(const catalog::TriangleMesh& other, catalog::TriangleMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const catalog::Triangle& face : other.faces)
    mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
}

}  // namespace shape_pipeline
