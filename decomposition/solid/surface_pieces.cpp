// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/surface_pieces.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "catalog/mass_properties.h"
#include "decomposition/geometry/box_heaps.h"
#include "decomposition/solid/ray_grid.h"

namespace decomposition {
namespace {

constexpr std::size_t kPlaces = 12;  // looked at for whether a surface lies in another; a cube has as many faces

/// One surface turned outwards, with its box.
struct Piece {
  std::vector<std::array<int, 3>> faces;
  Box box;
  double volume = 0;  // as found, signed
};

/// Piece of each face, numbered in the order of first appearance; vertices in common join faces.
std::vector<int> numbered_pieces(const catalog::TriangleMesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto at = [&](int v) -> int& { return parent[static_cast<std::size_t>(v)]; };
  const auto root = [&](int v) {
    while (at(v) != v) v = at(v) = at(at(v));
    return v;
  };
  for (const catalog::Triangle& face : mesh.faces)
    for (std::size_t k = 1; k < 3; ++k) {
      const int a = root(face[0]), b = root(face[k]);
      at(std::max(a, b)) = std::min(a, b);
    }
  std::vector<int> number(mesh.vertices.size(), -1), piece_of;
  piece_of.reserve(mesh.faces.size());
  int count = 0;
  for (const catalog::Triangle& face : mesh.faces) {
    int& n = number[static_cast<std::size_t>(root(face[0]))];
    if (n < 0) n = count++;
    piece_of.push_back(n);
  }
  return piece_of;
}

std::vector<Piece> outward_pieces(const catalog::TriangleMesh& mesh, const std::vector<int>& piece_of) {
  std::vector<Piece> pieces(static_cast<std::size_t>(*std::max_element(piece_of.begin(), piece_of.end())) + 1);
  const auto vertex = [&](int v) { return to_vec3(mesh.vertices[static_cast<std::size_t>(v)]); };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    Piece& piece = pieces[static_cast<std::size_t>(piece_of[f])];
    if (piece.faces.empty()) piece.box = {vertex(mesh.faces[f][0]), vertex(mesh.faces[f][0])};
    piece.faces.push_back(mesh.faces[f]);
    for (const int v : mesh.faces[f]) piece.box.extend(vertex(v));
  }
  for (Piece& piece : pieces) {
    const Vec3 reference = vertex(piece.faces.front()[0]);
    for (const auto& [a, b, c] : piece.faces)
      piece.volume += dot(vertex(a) - reference, cross(vertex(b) - reference, vertex(c) - reference)) / 6;
    if (piece.volume < 0)
      for (auto& face : piece.faces) std::swap(face[1], face[2]);
  }
  return pieces;
}

bool is_in_box(const Box& small, const Box& large) {
  return small.low.x >= large.low.x && small.low.y >= large.low.y && small.low.z >= large.low.z &&
         small.high.x <= large.high.x && small.high.y <= large.high.y && small.high.z <= large.high.z;
}

/// Whether the piece winds round p: one ray along z through it.
bool holds(const Piece& piece, const std::vector<Vec3>& vertices, const Vec3& p) {
  RayGrid ray;
  ray.cell = piece.box.diagonal();
  ray.x0 = p.x - ray.cell / 2;
  ray.y0 = p.y - ray.cell / 2;
  ray.nx = ray.ny = 1;
  const RayIntervals inside = intersect(ray, vertices, piece.faces);
  return std::any_of(inside.intervals.begin(), inside.intervals.end(),
                     [&](const ZInterval& stretch) { return p.z > stretch.low && p.z < stretch.high; });
}

/// Whether `inner` lies in `outer`: the middles of some of its faces do, so that touching with a few is no matter.
bool lies_in(const Piece& inner, const Piece& outer, const std::vector<Vec3>& vertices) {
  if (!is_in_box(inner.box, outer.box)) return false;
  const std::size_t count = std::min(inner.faces.size(), kPlaces);
  for (std::size_t k = 0; k < count; ++k) {
    Vec3 middle;
    for (const int v : inner.faces[k * inner.faces.size() / count])
      middle += (1 / 3.0) * vertices[static_cast<std::size_t>(v)];
    if (!holds(outer, vertices, middle)) return false;
  }
  return true;
}

PieceRole role_of(bool is_outward, int winding_around) {
  if (is_outward)
    return winding_around == 0 ? PieceRole::body : (winding_around > 0 ? PieceRole::inner : PieceRole::inverted);
  return winding_around == 1 ? PieceRole::cavity : (winding_around > 1 ? PieceRole::inner : PieceRole::inverted);
}

}  // namespace

void add_face(const catalog::TriangleMesh& mesh, std::size_t face, std::vector<int>& number,
              catalog::TriangleMesh& result) {
  catalog::Triangle corners = mesh.faces[face];
  for (int& v : corners) {
    int& renumbered = number[static_cast<std::size_t>(v)];
    if (renumbered < 0) {
      renumbered = static_cast<int>(result.vertices.size());
      result.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    }
    v = renumbered;
  }
  result.faces.push_back(corners);
}

int SurfacePieces::count(PieceRole role) const {
  return static_cast<int>(
      std::count_if(pieces.begin(), pieces.end(), [&](const SurfacePiece& piece) { return piece.role == role; }));
}

int count_pieces(const catalog::TriangleMesh& mesh) {
  const std::vector<int> piece_of = numbered_pieces(mesh);
  return piece_of.empty() ? 0 : *std::max_element(piece_of.begin(), piece_of.end()) + 1;
}

SurfacePieces surface_pieces(const catalog::TriangleMesh& mesh) {
  SurfacePieces result;
  result.piece_of = numbered_pieces(mesh);
  if (mesh.faces.empty()) return result;
  const std::vector<Piece> pieces = outward_pieces(mesh, result.piece_of);
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const catalog::Point& p : mesh.vertices) vertices.push_back(to_vec3(p));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    int winding = 0;
    SurfacePiece piece;
    piece.volume = pieces[i].volume;
    for (std::size_t j = 0; j < pieces.size(); ++j) {
      if (j == i || !lies_in(pieces[i], pieces[j], vertices)) continue;
      winding += pieces[j].volume > 0 ? 1 : -1;
      const bool is_nearer = piece.body < 0 || pieces[j].volume < pieces[static_cast<std::size_t>(piece.body)].volume;
      if (pieces[j].volume > 0 && is_nearer) piece.body = static_cast<int>(j);
    }
    piece.role = role_of(pieces[i].volume > 0, winding);
    if (piece.role != PieceRole::cavity) piece.body = -1;
    result.pieces.push_back(piece);
  }
  return result;
}

void add_mesh(const catalog::TriangleMesh& other, catalog::TriangleMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const catalog::Triangle& face : other.faces)
    mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
}

std::vector<catalog::TriangleMesh> separate_bodies(const catalog::TriangleMesh& mesh) {
  if (count_pieces(mesh) < 2) return {};
  const SurfacePieces found = surface_pieces(mesh);
  const int bodies = found.count(PieceRole::body);
  const int surfaces = static_cast<int>(found.pieces.size());
  if (bodies < 2 || bodies + found.count(PieceRole::cavity) < surfaces) return {};
  std::vector<int> body_of(found.pieces.size());  // counted without the cavities
  int count = 0;
  for (std::size_t p = 0; p < body_of.size(); ++p)
    if (found.pieces[p].role == PieceRole::body) body_of[p] = count++;
  for (std::size_t p = 0; p < body_of.size(); ++p)
    if (found.pieces[p].role == PieceRole::cavity) body_of[p] = body_of[static_cast<std::size_t>(found.pieces[p].body)];
  std::vector<catalog::TriangleMesh> result(static_cast<std::size_t>(bodies));
  std::vector<int> number(mesh.vertices.size(), -1);  // no two surfaces share a vertex
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const int body = body_of[static_cast<std::size_t>(found.piece_of[f])];
    add_face(mesh, f, number, result[static_cast<std::size_t>(body)]);
  }
  return result;
}

std::vector<catalog::TriangleMesh> bodies_apart(const catalog::TriangleMesh& mesh) {
  const std::vector<catalog::TriangleMesh> bodies = separate_bodies(mesh);
  std::vector<Box> boxes;
  for (const catalog::TriangleMesh& body : bodies) boxes.push_back(bounding_box(body));
  std::vector<catalog::TriangleMesh> result;
  for (const Heap& heap : heaps_of(boxes)) {
    result.emplace_back();
    for (const std::size_t body : heap) add_mesh(bodies[body], result.back());
  }
  if (result.size() == 1) result.clear();
  return result;
}

}  // namespace decomposition
