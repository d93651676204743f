// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/solid_union.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "catalog/mass_properties.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/self_intersections.h"
#include "shape_pipeline/meshes/surface_pieces.h"
#include "shape_pipeline/meshes/surface_union.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kTouch = 1e-9;  // of a solid's size: what rounding leaves of a touch is less

catalog::TriangleMesh drawn_together(catalog::TriangleMesh mesh) {
  const catalog::Point centre = catalog::mass_properties(mesh).centroid;
  for (catalog::Point& p : mesh.vertices) p = add(centre, scaled(subtract(p, centre), 1 - kTouch));
  return mesh;
}

/// Groups of indices.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  std::vector<std::size_t> parent_;
};

struct Box {
  catalog::Point low, high;

  explicit Box(const catalog::TriangleMesh& mesh) : low(mesh.vertices.front()), high(low) {
    for (const catalog::Point& p : mesh.vertices)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
  }

  bool meets(const Box& other) const {
    for (std::size_t i = 0; i < 3; ++i)
      if (low[i] > other.high[i] || other.low[i] > high[i]) return false;
    return true;
  }
  bool holds(const Box& other) const {
    for (std::size_t i = 0; i < 3; ++i)
      if (other.low[i] < low[i] || other.high[i] > high[i]) return false;
    return true;
  }
};

/// Solids that may meet, by crossing faces or one in the box of another.
Groups meeting(const std::vector<catalog::TriangleMesh>& solids, std::string& refusal) {
  catalog::TriangleMesh all;
  std::vector<std::size_t> solid_of;
  std::vector<Box> boxes;
  for (std::size_t s = 0; s < solids.size(); ++s) {
    append(solids[s], all);
    solid_of.resize(all.faces.size(), s);
    boxes.emplace_back(solids[s]);
  }
  Groups groups(solids.size());
  for (const auto& [a, b] : self_intersecting_faces(all)) {
    if (solid_of[a] == solid_of[b]) refusal = "a cavity cuts the body that holds it";
    groups.join(solid_of[a], solid_of[b]);
  }
  for (std::size_t a = 0; a < solids.size(); ++a)
    for (std::size_t b = 0; b < solids.size(); ++b)
      if (a != b && boxes[a].holds(boxes[b])) groups.join(a, b);
  return groups;
}

/// Whether two solids share but edges or corners: drawn together by a billionth of its size, neither meets the other
/// any more. Bodies that hook into one another do not come apart so, and are taken to cut.
bool merely_touch(const catalog::TriangleMesh& a, const catalog::TriangleMesh& b) {
  const std::size_t faces = drawn_together(a).faces.size();
  catalog::TriangleMesh both = drawn_together(a);
  append(drawn_together(b), both);
  const auto pairs = self_intersecting_faces(both);
  return std::none_of(pairs.begin(), pairs.end(),
                      [&](const auto& pair) { return (pair.first < faces) != (pair.second < faces); });
}

/// Adds a solid to others that do not meet one another but in edges and corners.
void add_solid(catalog::TriangleMesh solid, std::vector<catalog::TriangleMesh>& lumps, SolidUnion& result) {
  for (std::size_t l = 0; l < lumps.size();) {
    if (!Box(lumps[l]).meets(Box(solid))) {
      ++l;
      continue;
    }
    if (std::optional<catalog::TriangleMesh> whole = united(lumps[l], solid)) {
      solid = std::move(*whole);
      lumps.erase(lumps.begin() + static_cast<std::ptrdiff_t>(l));
      l = 0;  // the larger one may meet what the smaller did not
      continue;
    }
    if (!merely_touch(lumps[l], solid)) {
      result.refusal = "its bodies cut one another and cannot be united";
      return;
    }
    ++l;
  }
  lumps.push_back(std::move(solid));
}

/// Pairs of faces where a surface cuts or touches itself, and of those where it touches another.
struct Contacts {
  std::size_t within = 0, between = 0;
};

Contacts contacts(const catalog::TriangleMesh& mesh) {
  const std::vector<int> surface = face_components(mesh);
  Contacts found;
  for (const auto& [a, b] : self_intersecting_faces(mesh)) ++(surface[a] == surface[b] ? found.within : found.between);
  return found;
}

}  // namespace

SolidUnion union_of_solids(const std::vector<catalog::TriangleMesh>& solids) {
  SolidUnion result;
  Groups groups = meeting(solids, result.refusal);
  std::size_t bodies = 0, left = 0;
  bool is_changed = false;
  for (std::size_t g = 0; g < solids.size() && result.refusal.empty(); ++g) {
    if (groups.root(g) != g) continue;
    std::vector<catalog::TriangleMesh> lumps;
    std::size_t members = 0;
    for (std::size_t s = g; s < solids.size() && result.refusal.empty(); ++s) {
      if (groups.root(s) != g) continue;
      add_solid(solids[s], lumps, result);
      ++members;
    }
    is_changed = is_changed || members > 1;
    bodies += members;
    for (const catalog::TriangleMesh& lump : lumps) {
      const std::vector<SurfacePiece> pieces = surface_pieces(lump);
      left += static_cast<std::size_t>(
          std::count_if(pieces.begin(), pieces.end(), [](const SurfacePiece& piece) { return piece.volume > 0; }));
      append(lump, result.mesh);
    }
  }
  if (!result.refusal.empty()) return result;
  result.united = bodies - std::min(bodies, left);
  const Contacts left_over = is_changed ? contacts(result.mesh) : Contacts{};
  result.touching = left_over.between;
  if (left_over.within > 0 || !mesh_topology(result.mesh).is_closed())
    result.refusal = "its bodies cut one another and cannot be united";
  return result;
}

}  // namespace shape_pipeline
