// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/solid_surface.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "decomposition/solid/solid_check.h"
#include "decomposition/solid/surface_pieces.h"

namespace decomposition {
namespace {

constexpr int kMostPieces = 1000;  // more is no body but a cloud of scraps, and slow to sort out

/// Number of the body of most rock, its cavities taken off.
int largest_body(const SurfacePieces& found) {
  std::vector<double> rock(found.pieces.size(), 0);
  for (std::size_t p = 0; p < rock.size(); ++p) {
    const SurfacePiece& piece = found.pieces[p];
    if (piece.role == PieceRole::body) rock[p] += piece.volume;
    if (piece.role == PieceRole::cavity) rock[static_cast<std::size_t>(piece.body)] += piece.volume;
  }
  return static_cast<int>(std::max_element(rock.begin(), rock.end()) - rock.begin());
}

/// The faces of the pieces that are kept, with the vertices that they use.
catalog::TriangleMesh kept_faces(const catalog::TriangleMesh& mesh, const SurfacePieces& found,
                                 const std::vector<char>& is_kept) {
  catalog::TriangleMesh result;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (is_kept[static_cast<std::size_t>(found.piece_of[f])]) add_face(mesh, f, number, result);
  return result;
}

[[noreturn]] void refuse_bodies(int bodies) {
  throw catalog::InputError("mesh: " + std::to_string(bodies) +
                            " separate bodies, expected one; take them as one grain with --bodies join, or the largest "
                            "alone with --bodies largest");
}

/// Sorts the surfaces out: which stay, and what is noted of them.
std::vector<char> kept_pieces(const SurfacePieces& found, SeparateBodies bodies, SurfaceNotes& notes) {
  notes.bodies = found.count(PieceRole::body);
  notes.inner_surfaces = found.count(PieceRole::inner);
  if (notes.bodies > 1 && bodies == SeparateBodies::refuse) refuse_bodies(notes.bodies);
  const int largest = largest_body(found);
  std::vector<char> is_kept;
  double volume = 0, left_out = 0;
  for (std::size_t p = 0; p < found.pieces.size(); ++p) {
    const SurfacePiece& piece = found.pieces[p];
    const int body = piece.role == PieceRole::cavity ? piece.body : static_cast<int>(p);
    const bool is_surface = piece.role != PieceRole::inner;
    const bool is_wanted = bodies == SeparateBodies::join || body == largest;
    if (is_surface) volume += piece.volume;
    if (is_surface && !is_wanted) left_out += piece.volume;
    is_kept.push_back(is_surface && is_wanted);
    notes.cavities += is_kept.back() && piece.role == PieceRole::cavity;
  }
  if (bodies == SeparateBodies::largest) {
    notes.other_bodies = notes.bodies - 1;
    notes.bodies = 1;
    notes.other_volume = left_out / volume;
  }
  return is_kept;
}

}  // namespace

std::string SurfaceNotes::json() const {
  char text[256];
  std::snprintf(text, sizeof text,
                "{\"bodies\":%d,\"cavities\":%d,\"inner_surfaces_left_out\":%d,\"bodies_left_out\":%d,"
                "\"volume_left_out_ratio\":%.17g,\"miscounted_volume_ratio\":%.17g}",
                bodies, cavities, inner_surfaces, other_bodies, other_volume, miscounted_volume);
  return text;
}

SolidSurface solid_surface(const catalog::TriangleMesh& mesh, SeparateBodies bodies) {
  check_closed_surface(mesh);
  SolidSurface result;
  const int count = count_pieces(mesh);
  if (count > kMostPieces)
    throw catalog::InputError("mesh: " + std::to_string(count) + " separate surfaces, expected at most " +
                              std::to_string(kMostPieces) + "; clean the scan with talus digitize");
  const bool is_inside_out = catalog::volume_moments(mesh).volume < 0;  // as a whole, which check_solid refuses
  if (count > 1 && !is_inside_out) {
    const SurfacePieces found = surface_pieces(mesh);
    if (const int inverted = found.count(PieceRole::inverted); inverted > 0)
      throw catalog::InputError("mesh: " + std::to_string(inverted) + " of " + std::to_string(count) +
                                " separate surfaces are inside out; turn their faces round, or repair the mesh with "
                                "talus digitize");
    const std::vector<char> is_kept = kept_pieces(found, bodies, result.notes);
    if (std::find(is_kept.begin(), is_kept.end(), 0) != is_kept.end())
      result.cleaned = kept_faces(mesh, found, is_kept);
  }
  result.notes.miscounted_volume = check_solid(result.cleaned ? *result.cleaned : mesh);
  return result;
}

}  // namespace decomposition
